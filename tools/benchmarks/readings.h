#pragma once
/// @file How often the truth is found from readings that another database made: another mesh, other
/// stiffness.

#include <string>
#include <vector>

#include "tools/trials/localisation.h"

namespace voussoir {

/// Where readings come from and what they are compared with: libraries of the same scenes and points.
struct TwoBridges {
  const Library& library;
  const ModelError& model_error;  ///< of the library
  const Library& truth;
};

/// Readings of a true scene as one instrument takes them.
struct Instrument {
  ReadingKind kind = ReadingKind::change;
  NoiseModel noise;        ///< relative noise of absolute readings, or a floor: the deviation of changes
  bool level_told = true;  ///< the lookup knows the noise level
};

struct Rates {
  Success success;
  int damaged = 0;              ///< some block is missing with more than 50 %
  std::vector<double> chances;  ///< of the predictive check at the likeliest scene
};

/// Looks readings of each of these scenes up among the scenes with the given numbers of missing blocks, so
/// many times each. Scenes that the truth lacks, or that do not stand in it, are left out.
Rates find_again(const TwoBridges& bridges, const std::vector<Scene>& scenes, const Prior& prior,
                 const Instrument& instrument, int times, std::uint64_t seed);

/// Wall singles that stand in both.
std::vector<Scene> standing_singles(const TwoBridges& bridges);

}  // namespace voussoir
