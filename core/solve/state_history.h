#pragma once
/// @file The implicit steps that led to a state of a scene, found from the fields of its states alone.

#include <functional>
#include <optional>

#include "core/solve/state_plan.h"
#include "core/statics/quasi_static_solver.h"
#include "core/statics/sensitivity.h"

namespace voussoir {

/// What the states of a bridge's scenes are found with. All that it refers to outlives it.
struct StateEquations {
  const EquilibriumSystem& system;
  const Coefficients& coefficients;
  const StatePlan& plan;
  /// Solves one stage and keeps its steps, if it can.
  std::function<Solution(const StageTask&)> solve;
  /// A loss whose stored field leaves no more of the forces unbalanced after one implicit step [largest nodal
  /// weight] is taken to have one; others are solved again in 2, 4, .. steps until the stored field is as
  /// near to equilibrium with what they leave in the joints. A hundredth moves a joint by some micrometres.
  double good_enough = 1e-2;
};

/// The steps that end in this state of the scene, of which the last one's equations hold what its joints
/// remember. `states` are the scene's and `intact` the intact bridge's. Of the steps that a loss is tried
/// with, those that leave the stored field nearest to equilibrium are taken. Nothing if the state or one
/// before it does not stand.
std::optional<SolvedHistory> history_of_state(const StateEquations& equations, const Scene& scene,
                                              std::size_t state, const SceneStates& states,
                                              const SceneStates& intact);

}  // namespace voussoir
