#include "generator/scene_derivatives.h"

#include "core/solve/history.h"

namespace voussoir {
namespace {

/// A stored field solves a step if no more of the forces is unbalanced [largest nodal weight]: that moves a
/// joint by a fraction of a micrometre.
constexpr double kSameEquilibrium = 1e-2;

}  // namespace

Eigen::MatrixXd SceneDerivatives::of(const Scene& scene, std::size_t state, const SceneStates& states,
                                     const SceneStates& intact) {
  const auto history = history_of(scene, state, states, intact);
  if (!history) return {};
  return derivatives_.solve(*history, equations_.readings).value_or(Eigen::MatrixXd());
}

std::optional<SolvedHistory> SceneDerivatives::history_of(const Scene& scene, std::size_t state,
                                                          const SceneStates& states,
                                                          const SceneStates& intact) const {
  const PlannedState& planned = study_.states[state];
  if (!states[state] || !stands(*states[state])) return std::nullopt;
  if (planned.is_loss() && scene.removed.empty()) return history_of(scene, kBuilt, states, intact);
  std::optional<SolvedHistory> history = SolvedHistory{};
  if (planned.before)
    history = planned.is_loss() ? history_of(Scene{}, kBuilt, intact, intact)
                                : history_of(scene, *planned.before, states, intact);
  if (history) append(scene, planned, *states[state], *history);
  return history;
}

void SceneDerivatives::append(const Scene& scene, const PlannedState& planned, const Solution& solution,
                              SolvedHistory& history) const {
  const Stage stage{.scene = scene, .load = planned.load};
  append_stage(equations_.system, equations_.coefficients, stage, solution, 1, history);
  if (!planned.is_loss() ||
      unbalanced_force(history.back().equations, history.back().displacement) <= kSameEquilibrium)
    return;
  history.pop_back();
  const State before{history.back().displacement,
                     updated_memory(history.back().equations, history.back().displacement)};
  const SceneSolver solver = study_.solver.make_solver(study_.bridge, study_.settings);
  const StageTask task{.stage = stage,
                       .start = &before.displacement,
                       .before = &before,
                       .steps = kStepsOfLoss,
                       .keeps_steps = true};
  const std::vector<Solution> anew = solver({&task, 1});
  const bool has_steps = anew.front().steps.size() + 1 == kStepsOfLoss;  // not every solver keeps them
  if (stands(anew.front()) && has_steps)
    append_stage(equations_.system, equations_.coefficients, stage, anew.front(), kStepsOfLoss, history);
  else
    append_stage(equations_.system, equations_.coefficients, stage, solution, 1, history);
}

}  // namespace voussoir
