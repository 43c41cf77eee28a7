#pragma once
/// @file Readings as somebody would take them at the control points of a true bridge.

#include <span>
#include <string_view>

#include "core/random.h"
#include "lookup/readings/readings_file.h"

namespace voussoir {

enum class ReadingsTaken {
  change,      ///< the difference of two epochs alone
  two_epochs,  ///< both epochs
  absolute     ///< the second epoch alone, since the bridge carried nothing
};

/// "change", "two epochs", "absolute"
std::string_view to_string(ReadingsTaken taken);

/// What a true bridge shows at two times [m], NaN where a block is gone.
struct Shown {
  std::span<const double> before;
  std::span<const double> after;
};

/// A file of readings of all control points with a Gaussian error, stated as each reading's sigma. `sigma`
/// [m] is the standard deviation of a change, or of an absolute reading; each of two epochs has the root of
/// half its square. Sensors on blocks that are gone are silent.
ReadingsFile take_readings(const Shown& shown, ReadingsTaken taken, double sigma, Random& random);

}  // namespace voussoir
