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

/// Where motions that are not followed to the end begin.
MotionStart start_of(const StageTask& task, const Structure& structure) {
  return task.hints.falls_by_one && !is_one_group(task.stage.scene, structure) ? MotionStart::from_singles
                                                                               : MotionStart::at_rest;
}

/// Those that have no answer yet.
std::vector<std::size_t> open_places(std::span<const StageTask> tasks,
                                     const std::vector<Solution>& solutions) {
  return places_where(tasks.size(), [&](std::size_t i) { return is_open(tasks[i], solutions[i]); });
}

/// Of these those of which long searches and motions may find one.
std::vector<std::size_t> promising_places(std::span<const StageTask> tasks,
                                          const std::vector<Solution>& solutions) {
  std::vector<std::size_t> places = open_places(tasks, solutions);
  std::erase_if(places, [&](std::size_t place) { return tasks[place].hints.open_likely; });
  return places;
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
  std::vector<Solution> solutions = search_from_starts(tasks);
  solutions = search_from_rest(tasks, Scenes::intact, std::move(solutions));
  solutions = find_near_falls(tasks, std::move(solutions));
  solutions = follow_motions(tasks, Followed::as_set, std::move(solutions));
  solutions = search_from_rest(tasks, Scenes::all, std::move(solutions));
  solutions = follow_motions(tasks, Followed::to_the_end, std::move(solutions));
  return settle(tasks, std::move(solutions),
                [&](std::span<const StageTask> stages) { return newton_.solve(stages); });
}

/// Newton's equilibria; `unresolved` where there is none, or where a fall is likelier.
std::vector<Solution> CombinedSolver::search_from_starts(std::span<const StageTask> tasks) {
  const bool falls_first = settings_.newton.skips.likely_falls;
  const auto places = places_where(
      tasks.size(), [&](std::size_t i) { return !(falls_first && tasks[i].hints.falls_likely); });
  std::vector<Solution> found = equilibria(newton_, tasks_at(tasks, places));
  std::vector<Solution> solutions(tasks.size());
  for (std::size_t k = 0; k < found.size(); ++k) solutions[places[k]] = std::move(found[k]);
  return solutions;
}

/// Takes the equilibria that Newton's patient phase finds from rest. All other scenes start from the intact
/// bridge, which shall have slipped only if it has to.
std::vector<Solution> CombinedSolver::search_from_rest(std::span<const StageTask> tasks, Scenes scenes,
                                                       std::vector<Solution> solutions) {
  std::vector<std::size_t> places = promising_places(tasks, solutions);
  if (scenes == Scenes::intact)
    std::erase_if(places, [&](std::size_t place) { return tasks[place].stage.scene.missing() > 0; });
  std::vector<StageTask> open = tasks_at(tasks, places);
  for (StageTask& task : open) {
    task.start = nullptr;
    task.patient_phase = true;
  }
  std::vector<Solution> found = equilibria(newton_, open);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (stands(found[k])) solutions[places[k]] = std::move(found[k]);
  return solutions;
}

/// Takes the falls that show near the missing blocks. What falls late is left to the whole bridge: a rim that
/// goes that far would itself count as moved away.
std::vector<Solution> CombinedSolver::find_near_falls(std::span<const StageTask> tasks,
                                                      std::vector<Solution> solutions) const {
  if (!settings_.falls_nearby) return solutions;
  const DecisionRules& rules = rules_of(Followed::as_set);
  for (const std::size_t place : open_places(tasks, solutions)) {
    if (falls_late(tasks[place], rules)) continue;
    if (auto fall = fall_nearby(tasks[place], motion_, rules)) solutions[place] = std::move(*fall);
  }
  return solutions;
}

/// Sets scenes in motion, which begins with nothing slipped: takes the collapses, and the equilibria near
/// where others come to rest.
std::vector<Solution> CombinedSolver::follow_motions(std::span<const StageTask> tasks, Followed followed,
                                                     std::vector<Solution> solutions) {
  const std::vector<std::size_t> open =
      followed == Followed::as_set ? open_places(tasks, solutions) : promising_places(tasks, solutions);
  std::vector<DynamicSolution> motions = motions_of(tasks_at(tasks, open), followed);

  std::vector<std::size_t> resting_at;
  std::vector<Solution> resting;
  std::vector<StageTask> tasks_at_rest;
  for (std::size_t k = 0; k < open.size(); ++k) {
    Solution& moved = motions[k].solution;
    if (moved.outcome == Outcome::collapsed) {
      solutions[open[k]] = std::move(moved);
    } else {
      resting_at.push_back(open[k]);
      tasks_at_rest.push_back(task_at_rest(tasks[open[k]], followed, moved));
      resting.push_back(std::move(moved));
    }
  }
  std::vector<Solution> found = equilibria_near(resting, std::move(tasks_at_rest));
  for (std::size_t k = 0; k < found.size(); ++k) solutions[resting_at[k]] = std::move(found[k]);
  return solutions;
}

const DecisionRules& CombinedSolver::rules_of(Followed followed) const {
  return followed == Followed::as_set ? settings_.motion.decision : settings_.patient;
}

/// Whether a scene falls only when something is far away: the intact bridge, as nobody builds what falls at
/// once and all other scenes start from it, and where already the start would count as moved away.
bool CombinedSolver::falls_late(const StageTask& task, const DecisionRules& rules) const {
  if (task.stage.scene.removed.empty()) return true;
  return task.start != nullptr &&
         !blocks_moved_beyond(motion_.moved_away(rules), newton_.system().structure->mesh, *task.start)
              .empty();
}

std::vector<DynamicSolution> CombinedSolver::motions_of(std::span<const StageTask> tasks, Followed followed) {
  const DecisionRules& rules = rules_of(followed);
  DecisionRules late_rules = far_fall_rules(rules);  // what falls far takes its time
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
      starts.push_back(followed == Followed::as_set ? start_of(tasks[place], *newton_.system().structure)
                                                    : MotionStart::at_rest);
    }
    std::vector<DynamicSolution> found = motion_.solve(scenes, late ? late_rules : rules, starts);
    for (std::size_t k = 0; k < places.size(); ++k) solutions[places[k]] = std::move(found[k]);
  }
  return solutions;
}

/// What rests for certain is searched for by the patient phase. A bridge with softer joints rests where its
/// own joints may have no equilibrium near.
StageTask CombinedSolver::task_at_rest(const StageTask& task, Followed followed,
                                       const Solution& resting) const {
  const bool rests = followed == Followed::to_the_end && !motion_.softens_joints() && stands(resting);
  return {.stage = task.stage, .slipped = task.slipped, .patient_phase = rests};
}

/// Equilibria near where the tasks have come to rest: with nothing slipped beforehand, unless a search for
/// one with some slip has failed already; otherwise with what the joints remember of the motion, as friction
/// holds what it has let slide.
std::vector<Solution> CombinedSolver::equilibria_near(std::span<const Solution> resting,
                                                      std::vector<StageTask> tasks) {
  std::vector<Solution> found(tasks.size());
  const auto search = [&](const std::vector<std::size_t>& places) {
    std::vector<Solution> solutions = equilibria(newton_, tasks_at(tasks, places));
    for (std::size_t k = 0; k < solutions.size(); ++k) found[places[k]] = std::move(solutions[k]);
  };
  for (std::size_t k = 0; k < tasks.size(); ++k) tasks[k].start = &resting[k].displacement;
  search(places_where(tasks.size(), [&](std::size_t k) { return !tasks[k].has_slipped(); }));
  const auto open =
      places_where(tasks.size(), [&](std::size_t k) { return !stands(found[k]) && has_slipped(resting[k]); });
  for (const std::size_t k : open) tasks[k].slipped = &resting[k].slipped;
  search(open);
  return found;
}

}  // namespace voussoir
