#include "generator/scenes/state_solving.h"

#include <limits>

#include "core/structure/mirror_symmetry.h"
#include "generator/scenes/scene_solving.h"

namespace voussoir {
namespace {

template <class Search>
std::vector<Solution> solve_searches(const StageSolver& solver, const std::vector<Search>& searches) {
  std::vector<StageTask> tasks;
  for (const Search& search : searches) tasks.push_back(search.whole_task());
  return solve_for_storage(solver, tasks);
}

/// A state that is another one's, too. What is remembered of it depends on its own stage.
Solution without_memory(Solution solution) {
  solution.memory.clear();
  return solution;
}

}  // namespace

/// A state to be searched for.
struct StateSolving::Search {
  SceneStates* states;  ///< where the answer belongs
  StageTask task;       ///< without what it points to, which is here
  std::optional<Field> start{};
  Eigen::Matrix2Xd slipped{};
  std::optional<State> before{};

  /// The task with pointers into this.
  StageTask whole_task() const {
    StageTask whole = task;
    whole.start = start ? &*start : nullptr;
    whole.before = before ? &*before : nullptr;
    whole.slipped = &slipped;
    return whole;
  }

  /// Lets what the lost blocks carried go in so many steps. Several begin where most of it is held.
  void lose_in(int count) {
    if (count == 1) return;
    task.steps = count;
    start = before->displacement;
  }
};

StageEquations StateSolving::equations(const Scene& scene, std::size_t state,
                                       std::vector<JointMemory> memory) const {
  return {system_, coefficients_, Stage{.scene = scene, .load = plan_[state].load}, std::move(memory)};
}

std::vector<JointMemory> StateSolving::memory_of_intact(const Field& displacement,
                                                        const Eigen::Matrix2Xd& slipped) const {
  return updated_memory(equations(Scene{}, kBuilt, memory_of_slip(slipped)), displacement);
}

std::vector<JointMemory> StateSolving::memory_before(const Scene& scene, std::size_t state,
                                                     SceneStates& states,
                                                     const std::vector<JointMemory>& of_intact) const {
  if (states[state] && has_slipped(*states[state])) return memory_of_slip(states[state]->slipped);
  if (!plan_[state].before) return {};
  if (!plan_[state].is_load)
    return scene.removed.empty() && states[kBuilt]
               ? memory_of_intact(states[kBuilt]->displacement, states[kBuilt]->slipped)
               : of_intact;
  Solution& before = *states[*plan_[state].before];
  if (before.memory.empty()) {
    before.memory = updated_memory(
        equations(scene, *plan_[state].before, memory_before(scene, *plan_[state].before, states, of_intact)),
        without_nan(before.displacement));
  }
  return before.memory;
}

/// The state if it follows from others without a search.
std::optional<Solution> StateSolving::without_search(const Scene& scene, std::size_t state,
                                                     const SceneStates& states,
                                                     const SearchBasis& basis) const {
  const PlannedState& planned = plan_[state];
  if (!planned.before) {
    if (auto falls = basis.falls.of(scene, bridge_, coefficients_)) return falls;
    if (!basis.composition.has_parts(scene, basis.starts)) return std::nullopt;
    const Eigen::Matrix2Xd slipped = basis.starts.slipped_for(scene);
    auto composed =
        basis.composition.of(scene, basis.starts, equations(scene, state, memory_of_slip(slipped)));
    if (composed) composed->slipped = slipped;
    return composed;
  }
  if (planned.is_load)
    return stands(*states[*planned.before]) ? std::nullopt
                                            : std::optional(without_memory(*states[*planned.before]));
  const bool loses_nothing = scene.removed.empty() || basis.starts.intact(kBuilt) == nullptr;
  const bool falls_anyway = !stands(*states[kBuilt]) && basis.falls.proved(scene);
  return loses_nothing || falls_anyway ? std::optional(without_memory(*states[kBuilt])) : std::nullopt;
}

StateSolving::Search StateSolving::one_step_search(const Scene& scene, std::size_t state, SceneStates& states,
                                                   const SearchBasis& basis) const {
  const PlannedState& planned = plan_[state];
  Search search{.states = &states, .task = {.stage = {.scene = scene, .load = planned.load}}};
  if (!planned.before) {
    if (!basis.warm_starts) return search;
    search.start = basis.starts.start_for(scene, state);
    search.slipped = basis.starts.slipped_for(scene);
    search.task.hints.falls_likely =
        basis.starts.falls_likely(scene, state) ||
        (basis.collapse_fields && fall_beside(scene, bridge_, coefficients_).has_value());
    search.task.hints.falls_by_one = basis.starts.falls_by_one(scene, state);
    search.task.hints.open_likely = basis.starts.open_likely(scene, state);
    search.task.starts_near = scene.missing() > 1;  // where what fewer missing blocks change adds up
    return search;
  }
  const Solution& own = *states[*planned.before];
  search.before.emplace(State{planned.is_load ? own.displacement : *basis.starts.intact(kBuilt),
                              memory_before(scene, state, states, basis.of_intact)});
  // What falls as built falls in a jump, too.
  search.task.may_jump = planned.is_load || stands(*states[kBuilt]);
  if (!basis.warm_starts)
    search.start = search.before->displacement;
  else if (stands(own))
    search.start = basis.starts.start_after(scene, own.displacement, *planned.before, state);
  else
    search.start = basis.starts.start_for(scene, state);
  return search;
}

StateSolving::Search StateSolving::search_for(const Scene& scene, std::size_t state, SceneStates& states,
                                              const SearchBasis& basis) const {
  Search search = one_step_search(scene, state, states, basis);
  if (plan_[state].is_loss()) search.lose_in(basis.steps.of(scene));
  return search;
}

/// The searches that a state needs; states that need none are filled in.
std::vector<StateSolving::Search> StateSolving::searches_of(std::size_t state, std::span<SceneGroup> groups,
                                                            const SearchBasis& basis) const {
  std::vector<Search> searches;
  const auto find = [&](const Scene& scene, SceneStates& states) {
    if (states[state]) return;
    states[state] = without_search(scene, state, states, basis);
    if (!states[state]) searches.push_back(search_for(scene, state, states, basis));
  };
  for (SceneGroup& group : groups) {
    if (group.needs_all || plan_[state].mirrors) find(group.solved, group.states);
    if (group.image && !plan_[state].mirrors) find(*group.image, group.image_states);
  }
  return searches;
}

void StateSolving::take(std::size_t state, Solution&& solution, const SearchBasis& basis,
                        SceneStates& states) const {
  if (!basis.collapse_fields && solution.outcome == Outcome::collapsed)
    solution.displacement.setConstant(std::numeric_limits<double>::quiet_NaN());
  const bool falls_as_built = plan_[state].is_loss() && !stands(solution) && !stands(*states[kBuilt]);
  states[state] = falls_as_built ? without_memory(*states[kBuilt]) : std::move(solution);
}

/// The state of the history, without loads, that a state begins with.
std::size_t StateSolving::history_of(std::size_t state) const {
  while (plan_[state].is_load) state = *plan_[state].before;
  return state;
}

/// Where a load follows on blocks that went in many steps, and only the state's end is known.
bool StateSolving::lacks_memory(const SceneGroup& group, bool is_image, std::size_t loss,
                                const SearchBasis& basis) const {
  const Scene& scene = is_image ? *group.image : group.solved;
  const SceneStates& states = is_image ? group.image_states : group.states;
  const Solution& lost = *states[loss];
  if (!stands(lost) || has_slipped(lost) || !lost.memory.empty() || basis.steps.of(scene) == 1) return false;
  if (without_search(scene, loss, states, basis)) return false;
  for (std::size_t state = loss + 1; state < plan_.size(); ++state) {
    const bool is_searched = is_image ? !plan_[state].mirrors : group.needs_all || plan_[state].mirrors;
    if (history_of(state) == loss && is_searched && !states[state]) return true;
  }
  return false;
}

void StateSolving::find_lacking_memory(const StageSolver& solver, std::size_t loss,
                                       std::span<SceneGroup> groups, const SearchBasis& basis) const {
  std::vector<Search> searches;
  for (SceneGroup& group : groups) {
    if (lacks_memory(group, false, loss, basis))
      searches.push_back(search_for(group.solved, loss, group.states, basis));
    if (group.image && lacks_memory(group, true, loss, basis))
      searches.push_back(search_for(*group.image, loss, group.image_states, basis));
  }
  std::vector<Solution> solutions = solve_searches(solver, searches);
  for (std::size_t i = 0; i < searches.size(); ++i)
    if (stands(solutions[i])) (*searches[i].states)[loss]->memory = std::move(solutions[i].memory);
}

void StateSolving::solve(const StageSolver& solver, const SearchBasis& basis,
                         std::span<SceneGroup> groups) const {
  for (SceneGroup& group : groups) {
    group.states.resize(plan_.size());
    group.image_states.resize(plan_.size());
  }
  for (std::size_t state = 0; state < plan_.size(); ++state) {
    const std::vector<Search> searches = searches_of(state, groups, basis);
    std::vector<Solution> solutions = solve_searches(solver, searches);
    for (std::size_t i = 0; i < searches.size(); ++i)
      take(state, std::move(solutions[i]), basis, *searches[i].states);
    for (SceneGroup& group : groups)
      if (group.image && plan_[state].mirrors)
        group.image_states[state] = mirrored_solution(*group.states[state], bridge_);
    if (plan_[state].is_loss()) find_lacking_memory(solver, state, groups, basis);
  }
}

void StateSolving::solve_from_intact(const StageSolver& solver, std::span<SceneGroup> groups) const {
  StartingFields starts;
  const std::span<SceneGroup> intact = groups.first(1);
  solve(solver, basis(solver, starts, PlanRules{}), intact);
  for (std::size_t state = 0; state < plan_.size(); ++state)
    starts.add({}, state, *intact.front().states[state]);
  solve(solver, basis(solver, std::move(starts), PlanRules{}), groups.subspan(1));
}

std::vector<SceneStates> StateSolving::states_from_intact(const StageSolver& solver,
                                                          const std::vector<Scene>& scenes) const {
  std::vector<SceneGroup> groups;
  for (const Scene& scene : scenes) groups.push_back({.solved = scene, .states = {}, .image = {}});
  solve_from_intact(solver, groups);
  std::vector<SceneStates> states;
  for (SceneGroup& group : groups) states.push_back(std::move(group.states));
  return states;
}

/// By solving those of the singles that stand as lost again in one step.
StepsOfLoss StateSolving::steps_of_loss(const StageSolver& solver, const SearchBasis& basis,
                                        std::size_t lost) const {
  const std::vector<Scene> singles = basis.starts.standing_singles(lost);
  std::vector<Search> searches;
  for (const Scene& single : singles) {
    SceneStates states(plan_.size());
    states[kBuilt].emplace();
    if (const Field* built = basis.starts.find(single, kBuilt))
      states[kBuilt] = Solution{{*built, {}}, Outcome::standing};
    searches.push_back(one_step_search(single, lost, states, basis));
  }
  const std::vector<Solution> in_one_step = solve_searches(solver, searches);
  const std::vector<ControlPoint> points = deciding_points(bridge_);
  StepsOfLoss steps;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    const Solution& one_step = in_one_step[i];
    const bool jumps = !stands(one_step) || has_slipped(one_step);
    if (jumps || differ_in_signal(one_step.displacement, *basis.starts.find(singles[i], lost),
                                  *basis.starts.intact(kBuilt), points))
      steps.add(singles[i].removed.front());
  }
  return steps;
}

SearchBasis StateSolving::basis(const StageSolver& solver, StartingFields starts,
                                const PlanRules& rules) const {
  SearchBasis basis{std::move(starts), rules.warm_starts, rules.collapse_fields, {}, {}, {}, {}};
  const Field* intact = basis.starts.intact(kBuilt);
  if (rules.composed && intact != nullptr && basis.starts.has_pairs())
    basis.composition =
        Composition(equations(Scene{}, kBuilt, memory_of_slip(basis.starts.slipped({}))), *intact);
  if (intact != nullptr) basis.of_intact = memory_of_intact(*intact, basis.starts.slipped({}));
  const auto lost = place_of_lost(plan_);
  basis.falls = ProvedFalls(basis.starts, bridge_, coefficients_, rules, lost.has_value());
  if (lost && intact != nullptr) basis.steps = steps_of_loss(solver, basis, *lost);
  return basis;
}

}  // namespace voussoir
