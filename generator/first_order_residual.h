#pragma once
/// @file What a first order leaves, found by solving bridges that are drawn at random.

#include "core/structure/uncertain_parameters.h"
#include "database/records/sensitivities.h"
#include "generator/sampled_histories.h"

namespace voussoir {

/// Bridges of which the intact scene is solved, with and without the movements of an epoch, and seeds of the
/// first: enough for the directions in which the control points of a bridge can err.
inline constexpr std::size_t kSampledBridges = 128;
inline constexpr std::uint64_t kFirstSampledSeed = 0x5eed0001;

/// Of so many of them some singles are solved as well, evenly spread over those that stand.
inline constexpr std::size_t kBridgesWithSingles = 6;
inline constexpr std::size_t kSampledSingles = 24;

/// The nominal bridge's answers.
struct NominalScenes {
  const std::vector<Scene>& scenes;        ///< the intact bridge first
  const std::vector<SceneStates>& states;  ///< of each scene
};

struct FirstOrder {
  NominalScenes nominal;
  const Derivatives& derivatives;  ///< of its scenes
};

/// One for each kept state. A bridge that does not stand is left out. Without a solver of equilibria (see
/// SolverChoice) they are zero; where no single stands in a sampled bridge its signals are taken to be off by
/// as much as the first order says, and `progress` is told.
std::vector<FirstOrderResidual> first_order_residuals(const SensitivityStudy& study,
                                                      const UncertainParameters& uncertain,
                                                      const FirstOrder& first_order, Progress& progress);

}  // namespace voussoir
