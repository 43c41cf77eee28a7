#pragma once
/// @file Series of trials: the same question about many true bridges.

#include "tools/trials/taken_readings.h"
#include "tools/trials/trial.h"
#include "tools/trials/true_bridges.h"

namespace voussoir {

/// How readings are taken in a series.
struct Taking {
  ReadingsTaken taken = ReadingsTaken::change;
  double sigma = 1e-5;     ///< [m] as in take_readings
  std::uint64_t seed = 1;  ///< of the errors; every trial draws its own
  std::size_t every = 1;   ///< take this one of so many scenes of a bridge
  std::string load{};      ///< that the true bridges' readings are of, where they are of one
};

/// Readings of the true bridges' scenes with so many missing blocks, each bridge's own ones. Absolute
/// readings are of the scene as built, others of blocks that were lost. Precondition: where readings are of
/// a load, the bridges have what it adds.
std::vector<Trial> look_for_damage(const Asking& asking, const std::vector<TrueBridge>& bridges, int missing,
                                   const Taking& taking);

/// An intact bridge at two times [m].
struct IntactBridge {
  std::vector<double> before;
  std::vector<double> after;
  std::vector<double> added_before{};  ///< what a load adds then; empty: none is asked about
  std::vector<double> added_after{};
};

/// Readings of intact bridges, one trial each.
std::vector<Trial> look_at_intact(const Asking& asking, const std::vector<IntactBridge>& bridges,
                                  const Taking& taking);

}  // namespace voussoir
