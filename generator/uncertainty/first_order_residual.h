#pragma once
/// @file What a first order leaves, found by solving bridges that are drawn at random.

#include "core/structure/uncertain_parameters.h"
#include "database/records/sensitivities.h"
#include "generator/uncertainty/sampled_histories.h"

namespace voussoir {

/// Bridges of which the intact scene is solved, with and without the movements of an epoch: five for each
/// point that is read, within bounds. A covariance from hardly more samples than it has directions is too
/// small for other bridges: the squared distances of 548 others were 1.33 times those of 1500 samples with
/// 128 samples of the reference bridge's 78 points, and 1.06 times with 512 (docs/uncertainty.md).
std::size_t sampled_bridge_count(std::size_t points);

/// The seed of the first.
inline constexpr std::uint64_t kFirstSampledSeed = 0x5eed0001;

/// Of so many of them the singles that stand are solved as well.
inline constexpr std::size_t kBridgesWithSingles = 4;

/// The nominal bridge's answers.
struct NominalScenes {
  const std::vector<Scene>& scenes;        ///< the intact bridge first
  const std::vector<SceneStates>& states;  ///< of each scene
};

struct FirstOrder {
  NominalScenes nominal;
  const Derivatives& derivatives;  ///< of its scenes
};

/// What sampled bridges show beyond the first order.
struct WhatIsLeft {
  std::vector<FirstOrderResidual> residuals;  ///< one for each kept state
  Derivatives signals;  ///< of each kept state and scene: SceneFactors::left; empty where nothing is known
};

/// A bridge that does not stand is left out. Without a solver of equilibria (see SolverChoice) nothing is
/// left; where no single stands in a sampled bridge its signals are taken to be off by as much as the first
/// order says, and `progress` is told.
WhatIsLeft what_is_left(const SensitivityStudy& study, const UncertainParameters& uncertain,
                        const FirstOrder& first_order, Progress& progress);

}  // namespace voussoir
