#include "core/solve/state_history.h"

#include "core/solve/history.h"

namespace voussoir {
namespace {

void append(const StateEquations& equations, const Scene& scene, const PlannedState& planned,
            const Solution& solution, SolvedHistory& history) {
  const Stage stage{.scene = scene, .load = planned.load};
  const auto append_in = [&](int steps, const Solution& end) {
    append_stage(equations.system, equations.coefficients, stage, end, steps, history);
  };
  append_in(1, solution);
  if (!planned.is_loss()) return;
  const double unbalanced = unbalanced_force(history.back().equations, solution.displacement);
  if (unbalanced <= equations.good_enough) return;
  const SolvedStep in_one = std::move(history.back());
  history.pop_back();
  const State before{history.back().displacement,
                     updated_memory(history.back().equations, history.back().displacement)};
  const Solution anew = equations.solve({.stage = stage,
                                         .start = &before.displacement,
                                         .before = &before,
                                         .steps = kStepsOfLoss,
                                         .keeps_steps = true});
  const bool has_steps = anew.steps.size() + 1 == kStepsOfLoss;  // not every solver keeps them
  const std::size_t steps_before = history.size();
  if (stands(anew) && has_steps) append_in(kStepsOfLoss, anew);
  if (history.size() > steps_before &&
      unbalanced_force(history.back().equations, solution.displacement) < unbalanced)
    return;
  history.erase(history.begin() + static_cast<std::ptrdiff_t>(steps_before), history.end());
  history.push_back(in_one);
}

}  // namespace

std::optional<SolvedHistory> history_of_state(const StateEquations& equations, const Scene& scene,
                                              std::size_t state, const SceneStates& states,
                                              const SceneStates& intact) {
  const PlannedState& planned = equations.plan[state];
  if (!states[state] || !stands(*states[state])) return std::nullopt;
  if (planned.is_loss() && scene.removed.empty())
    return history_of_state(equations, scene, kBuilt, states, intact);
  std::optional<SolvedHistory> history = SolvedHistory{};
  if (planned.before)
    history = planned.is_loss() ? history_of_state(equations, Scene{}, kBuilt, intact, intact)
                                : history_of_state(equations, scene, *planned.before, states, intact);
  if (history) append(equations, scene, planned, *states[state], *history);
  return history;
}

}  // namespace voussoir
