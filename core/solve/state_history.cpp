#include "core/solve/state_history.h"

#include <algorithm>
#include <iterator>

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
  const auto unbalanced = [&] { return unbalanced_force(history.back().equations, solution.displacement); };
  double least = unbalanced();
  SolvedHistory best;
  best.push_back(std::move(history.back()));
  history.pop_back();
  const State before{history.back().displacement,
                     updated_memory(history.back().equations, history.back().displacement)};
  const std::size_t steps_before = history.size();
  for (int steps = 2; least > equations.good_enough && steps <= kStepsOfLoss; steps *= 2) {
    const Solution anew = equations.solve({.stage = stage,
                                           .start = &before.displacement,
                                           .before = &before,
                                           .steps = steps,
                                           .keeps_steps = true});
    const bool keeps_steps =
        anew.steps.size() + 1 == static_cast<std::size_t>(steps);  // not every solver does
    if (!stands(anew) || !keeps_steps) continue;
    append_in(steps, anew);
    if (const double left = unbalanced(); left < least) {
      least = left;
      best.assign(history.begin() + static_cast<std::ptrdiff_t>(steps_before), history.end());
    }
    history.erase(history.begin() + static_cast<std::ptrdiff_t>(steps_before), history.end());
  }
  std::ranges::move(best, std::back_inserter(history));
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
