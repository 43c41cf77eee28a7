#pragma once
/// @file Readings as they are shown: a change as a change.

#include <vector>

#include "lookup/readings/comparison.h"

namespace voussoir {

/// [m] Without what `compare` added to changes.
struct ShownReadings {
  std::vector<double> reading;   ///< by channel; NaN where there is none
  std::vector<double> expected;  ///< by channel, of one scene
};
ShownReadings shown_readings(const Comparison& comparison, std::size_t row);

}  // namespace voussoir
