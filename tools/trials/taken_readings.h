#pragma once
/// @file Readings as somebody would take them at the control points of a true bridge.

#include <span>
#include <string>
#include <string_view>

#include "core/random.h"
#include "lookup/readings/readings_file.h"

namespace voussoir {

enum class ReadingsTaken {
  change,      ///< the difference of two epochs alone
  two_epochs,  ///< both epochs
  absolute,    ///< the second epoch alone, since the bridge carried nothing
  load,        ///< what a load adds in the second epoch
  load_change  ///< how much more it adds in the second than in the first
};

/// "change", "two epochs", "absolute", "load", "load change"
std::string_view to_string(ReadingsTaken taken);

/// Does it need what a load adds?
constexpr bool is_loaded(ReadingsTaken taken) {
  return taken == ReadingsTaken::load || taken == ReadingsTaken::load_change;
}

/// What a true bridge shows at two times [m], or what a load adds then; NaN where a block is gone.
struct Shown {
  std::span<const double> before;
  std::span<const double> after;
};

/// A file of readings of all control points with a Gaussian error, stated as each reading's sigma. `sigma`
/// [m] is the standard deviation of a change, or of a reading of the second epoch alone; each of two epochs
/// has the root of half its square. Sensors on blocks that are gone are silent. `load`: the name of what is
/// read under.
ReadingsFile take_readings(const Shown& shown, ReadingsTaken taken, double sigma, Random& random,
                           const std::string& load = {});

}  // namespace voussoir
