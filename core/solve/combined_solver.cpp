#include "core/solve/combined_solver.h"

#include "core/solve/near_falls.h"
#include "core/solve/settling.h"
#include "core/structure/collapse.h"
#include "core/structure/neighbours.h"

namespace voussoir {
namespace {

template <typename Predicate>
std::vector<std::size_t> places_where(std::size_t count, Predicate holds) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i)
    if (holds(i)) places.push_back(i);
  return places;
}

std::vector<StageTask> tasks_at(std::span<const StageTask> tasks, std::span<const std::size_t> places) {
  std::vector<StageTask> result;
  for (const std::size_t place : places) result.push_back(tasks[place]);
  return result;
}

/// Has the scene no answer yet? Later stages are left to the first search.
bool is_open(const StageTask& task, const Solution& solution) {
  return solution.outcome == Outcome::unresolved && task.before == nullptr;
}

/// Newton's equilibria. Where it gets too far away, motion shall say whether anything falls.
std::vector<Solution> equilibria(QuasiStaticSolver& newton, const std::vector<StageTask>& tasks) {
  std::vector<Solution> solutions = newton.solve(tasks);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (solutions[i].outcome != Outcome::collapsed || tasks[i].before != nullptr) continue;
    solutions[i].outcome = Outcome::unresolved;
    solutions[i].extent = CollapseExtent::none;
    solutions[i].moving.clear();
  }
  return solutions;
}

/// What is looked at with all patience begins at rest.
MotionStart start_of(const StageTask& task, const Structure& structure, bool patiently) {
  const bool adds_up = task.falls_by_one && !patiently && !is_one_group(task.stage.scene, structure);
  return adds_up ? MotionStart::from_singles : MotionStart::at_rest;
}

/// Those that have no answer yet; `patiently`: of them those that are worth it.
std::vector<std::size_t> open_places(std::span<const StageTask> tasks, const std::vector<Solution>& solutions,
                                     bool patiently) {
  return places_where(tasks.size(), [&](std::size_t i) {
    return is_open(tasks[i], solutions[i]) && !(patiently && tasks[i].open_likely);
  });
}

}  // namespace

CombinedSolver::CombinedSolver(const Model& model, const SolverSettings& settings)
    : settings_(settings),
      newton_(model, settings.newton),
      motion_(model, newton_.system(), settings.motion) {
  settings_.patient.latest_decision =
      std::max(settings_.patient.latest_decision, settings_.motion.decision.latest_decision);
}

std::vector<Solution> CombinedSolver::solve(std::span<const StageTask> tasks) {
  std::vector<Solution> solutions = search(tasks);
  insist(tasks, Whom::intact, solutions);
  look_nearby(tasks, solutions);
  follow(settings_.motion.decision, tasks, false, solutions);
  insist(tasks, Whom::all, solutions);
  follow(settings_.patient, tasks, true, solutions);
  return settle(tasks, std::move(solutions),
                [&](std::span<const StageTask> stages) { return newton_.solve(stages); });
}

/// Newton's equilibria; `unresolved` where there is none, or where a fall is likelier.
std::vector<Solution> CombinedSolver::search(std::span<const StageTask> tasks) {
  const bool falls_first = settings_.newton.skips.likely_falls;
  const auto places =
      places_where(tasks.size(), [&](std::size_t i) { return !(falls_first && tasks[i].falls_likely); });
  std::vector<Solution> found = equilibria(newton_, tasks_at(tasks, places));
  std::vector<Solution> solutions(tasks.size());
  for (std::size_t k = 0; k < found.size(); ++k) solutions[places[k]] = std::move(found[k]);
  return solutions;
}

/// Takes the falls that show near the missing blocks. What falls late is left to the whole bridge: a rim that
/// goes that far would itself count as moved away.
void CombinedSolver::look_nearby(std::span<const StageTask> tasks, std::vector<Solution>& solutions) const {
  if (!settings_.falls_nearby) return;
  const DecisionRules& rules = settings_.motion.decision;
  for (const std::size_t place : open_places(tasks, solutions, false)) {
    if (falls_late(tasks[place], rules)) continue;
    if (auto fall = fall_nearby(tasks[place], motion_, rules)) solutions[place] = std::move(*fall);
  }
}

/// Takes the equilibria that Newton's method finds with all patience, from rest. All other scenes start from
/// the intact bridge, which shall have slipped only if it has to.
void CombinedSolver::insist(std::span<const StageTask> tasks, Whom whom, std::vector<Solution>& solutions) {
  std::vector<std::size_t> places = open_places(tasks, solutions, true);
  if (whom == Whom::intact)
    std::erase_if(places, [&](std::size_t place) { return tasks[place].stage.scene.missing() > 0; });
  std::vector<StageTask> open = tasks_at(tasks, places);
  for (StageTask& task : open) {
    task.start = nullptr;
    task.patiently = true;
  }
  std::vector<Solution> found = equilibria(newton_, open);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (stands(found[k])) solutions[places[k]] = std::move(found[k]);
}

/// Whether a scene falls only when something is far away: the intact bridge, as nobody builds what falls at
/// once and all other scenes start from it, and where already the start would count as moved away.
bool CombinedSolver::falls_late(const StageTask& task, const DecisionRules& rules) const {
  if (task.stage.scene.removed.empty()) return true;
  return task.start != nullptr &&
         !blocks_moved_beyond(motion_.moved_away(rules), newton_.system().structure->mesh, *task.start)
              .empty();
}

std::vector<DynamicSolution> CombinedSolver::move(std::span<const StageTask> tasks,
                                                  const DecisionRules& rules, bool patiently) {
  DecisionRules late_rules = when_gone(rules);  // which takes its time
  late_rules.latest_decision = settings_.patient.latest_decision;
  std::vector<bool> fall_late;
  for (const StageTask& task : tasks) fall_late.push_back(falls_late(task, rules));
  std::vector<DynamicSolution> solutions(tasks.size());
  for (const bool late : {false, true}) {
    const auto places = places_where(tasks.size(), [&](std::size_t i) { return fall_late[i] == late; });
    std::vector<Scene> scenes;
    std::vector<MotionStart> starts;
    for (const std::size_t place : places) {
      scenes.push_back(tasks[place].stage.scene);
      starts.push_back(start_of(tasks[place], *newton_.system().structure, patiently));
    }
    std::vector<DynamicSolution> found = motion_.solve(scenes, late ? late_rules : rules, starts);
    for (std::size_t k = 0; k < places.size(); ++k) solutions[places[k]] = std::move(found[k]);
  }
  return solutions;
}

/// Sets the scenes that are still open in motion, which begins with nothing slipped: takes the collapses,
/// polishes what rests; with all patience what rests for certain. A bridge with softer joints rests where its
/// own joints may have no equilibrium near.
void CombinedSolver::follow(const DecisionRules& rules, std::span<const StageTask> tasks, bool patiently,
                            std::vector<Solution>& solutions) {
  const std::vector<std::size_t> open = open_places(tasks, solutions, patiently);
  std::vector<DynamicSolution> motions = move(tasks_at(tasks, open), rules, patiently);

  std::vector<StageTask> tasks_at_rest;
  std::vector<Solution> resting;
  std::vector<std::size_t> resting_at;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (motions[k].solution.outcome == Outcome::collapsed) {
      solutions[open[k]] = std::move(motions[k].solution);
    } else {
      const bool rests = patiently && !motion_.softens_joints() && stands(motions[k].solution);
      tasks_at_rest.push_back(
          {.stage = tasks[open[k]].stage, .slipped = tasks[open[k]].slipped, .patiently = rests});
      resting.push_back(std::move(motions[k].solution));
      resting_at.push_back(open[k]);
    }
  }
  std::vector<Solution> polished = polish(std::move(tasks_at_rest), resting);
  for (std::size_t k = 0; k < polished.size(); ++k) solutions[resting_at[k]] = std::move(polished[k]);
}

/// Equilibria near where the tasks have come to rest: with nothing slipped beforehand, unless a search for
/// one with some slip has failed already; otherwise with what the joints remember of the motion, as friction
/// holds what it has let slide.
std::vector<Solution> CombinedSolver::polish(std::vector<StageTask> tasks,
                                             std::span<const Solution> resting) {
  std::vector<Solution> polished(tasks.size());
  const auto take = [&](const std::vector<std::size_t>& places) {
    std::vector<Solution> found = equilibria(newton_, tasks_at(tasks, places));
    for (std::size_t k = 0; k < found.size(); ++k) polished[places[k]] = std::move(found[k]);
  };
  for (std::size_t k = 0; k < tasks.size(); ++k) tasks[k].start = &resting[k].displacement;
  take(places_where(tasks.size(), [&](std::size_t k) { return !tasks[k].has_slipped(); }));
  const auto open = places_where(
      tasks.size(), [&](std::size_t k) { return !stands(polished[k]) && has_slipped(resting[k]); });
  for (const std::size_t k : open) tasks[k].slipped = &resting[k].slipped;
  take(open);
  return polished;
}

}  // namespace voussoir
