#include "generator/state_solving.h"

#include "core/structure/mirror_symmetry.h"

namespace voussoir {
namespace {

constexpr std::size_t kBuilt = 0;

bool stands(const Solution& solution) {
  return solution.outcome == Outcome::standing;
}

/// A state that is another one's, too. What is remembered of it depends on its own stage.
Solution without_memory(Solution solution) {
  solution.memory.clear();
  return solution;
}

}  // namespace

/// A state to be searched for, with all that its task points to.
struct StateSolving::Search {
  SceneStates* states;  ///< where the answer belongs
  Stage stage;
  std::optional<Field> start;
  std::optional<State> before;

  StageTask task() const {
    return {.stage = stage, .start = start ? &*start : nullptr, .before = before ? &*before : nullptr};
  }
};

StageEquations StateSolving::equations(const Scene& scene, std::size_t state,
                                       std::vector<JointMemory> memory) const {
  return {system_, coefficients_, Stage{.scene = scene, .load = plan_[state].load}, std::move(memory)};
}

std::vector<JointMemory> StateSolving::memory_of_intact(const Field* intact) const {
  return intact == nullptr ? std::vector<JointMemory>{}
                           : updated_memory(equations(Scene{}, kBuilt, {}), *intact);
}

std::vector<JointMemory> StateSolving::memory_before(const Scene& scene, std::size_t state,
                                                     SceneStates& states,
                                                     const std::vector<JointMemory>& of_intact) const {
  if (!plan_[state].before) return {};
  if (!plan_[state].is_load)
    return scene.removed.empty() && states[kBuilt] ? memory_of_intact(&states[kBuilt]->displacement)
                                                   : of_intact;
  Solution& before = *states[*plan_[state].before];
  if (before.memory.empty()) {
    const Field& end = before.displacement;
    before.memory = updated_memory(
        equations(scene, *plan_[state].before, memory_before(scene, *plan_[state].before, states, of_intact)),
        end.array().isNaN().select(0.0, end));
  }
  return before.memory;
}

/// The state if it follows from others without a search.
std::optional<Solution> StateSolving::without_search(const Scene& scene, std::size_t state,
                                                     const SceneStates& states,
                                                     const StartingFields& starts) const {
  const PlannedState& planned = plan_[state];
  if (!planned.before) return std::nullopt;
  if (planned.is_load)
    return stands(*states[*planned.before]) ? std::nullopt
                                            : std::optional(without_memory(*states[*planned.before]));
  const bool loses_nothing = scene.removed.empty() || starts.intact(kBuilt) == nullptr;
  return loses_nothing ? std::optional(without_memory(*states[kBuilt])) : std::nullopt;
}

StateSolving::Search StateSolving::search_for(const Scene& scene, std::size_t state, SceneStates& states,
                                              const Shared& shared) const {
  const PlannedState& planned = plan_[state];
  Search search{&states, {.scene = scene, .load = planned.load}, {}, {}};
  if (!planned.before) {
    if (shared.warm_starts) search.start = shared.starts.start_for(scene, state);
    return search;
  }
  search.before.emplace(State{{}, memory_before(scene, state, states, shared.of_intact)});
  const Solution& own = *states[*planned.before];
  if (!shared.warm_starts)
    search.start = planned.is_load ? own.displacement : *shared.starts.intact(kBuilt);
  else if (stands(own))
    search.start = shared.starts.start_after(scene, own.displacement, *planned.before, state);
  else
    search.start = shared.starts.start_for(scene, state);
  return search;
}

/// The searches that a state needs; states that need none are filled in.
std::vector<StateSolving::Search> StateSolving::searches_of(std::size_t state, std::span<SceneGroup> groups,
                                                            const Shared& shared) const {
  std::vector<Search> searches;
  const auto find = [&](const Scene& scene, SceneStates& states) {
    if (states[state]) return;
    states[state] = without_search(scene, state, states, shared.starts);
    if (!states[state]) searches.push_back(search_for(scene, state, states, shared));
  };
  for (SceneGroup& group : groups) {
    if (group.needs_all || plan_[state].mirrors) find(group.solved, group.states);
    if (group.image && !plan_[state].mirrors) find(*group.image, group.image_states);
  }
  return searches;
}

void StateSolving::take(std::size_t state, Solution&& solution, SceneStates& states) const {
  const bool is_lost = plan_[state].before && !plan_[state].is_load;
  const bool falls_as_built = is_lost && !stands(solution) && !stands(*states[kBuilt]);
  states[state] = falls_as_built ? without_memory(*states[kBuilt]) : std::move(solution);
}

void StateSolving::solve(const SceneSolver& solver, const StartingFields& starts, bool warm_starts,
                         std::span<SceneGroup> groups) const {
  const Shared shared{starts, warm_starts, memory_of_intact(starts.intact(kBuilt))};
  for (SceneGroup& group : groups) {
    group.states.resize(plan_.size());
    group.image_states.resize(plan_.size());
  }
  for (std::size_t state = 0; state < plan_.size(); ++state) {
    const std::vector<Search> searches = searches_of(state, groups, shared);
    std::vector<StageTask> tasks;
    for (const Search& search : searches) tasks.push_back(search.task());
    std::vector<Solution> solutions = solve_for_storage(solver, tasks);
    for (std::size_t i = 0; i < searches.size(); ++i)
      take(state, std::move(solutions[i]), *searches[i].states);
    for (SceneGroup& group : groups)
      if (group.image && plan_[state].mirrors)
        group.image_states[state] = mirrored_solution(*group.states[state], *bridge_.symmetry);
  }
}

}  // namespace voussoir
