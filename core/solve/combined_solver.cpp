#include "core/solve/combined_solver.h"

#include "core/solve/softer_joints.h"

namespace voussoir {

CombinedSolver::CombinedSolver(const Model& model, const SolverSettings& settings)
    : settings_(settings),
      parameters_(&model.parameters),
      newton_(model, settings.newton),
      motion_(model, newton_.system(), settings.motion) {
  if (settings.softest_joints < 1.0) approaching_.emplace(model, approaching(settings.newton));
}

std::vector<Solution> CombinedSolver::solve(std::span<const StageTask> tasks) {
  std::vector<Solution> solutions = search(tasks);
  const std::vector<bool> stand_softer = approach(tasks, solutions);
  follow(settings_.motion.decision, tasks, stand_softer, false, solutions);
  insist(tasks, solutions);
  follow(settings_.patient, tasks, stand_softer, true, solutions);
  return solutions;
}

/// Newton's equilibria; `unresolved` where there is none, or where a fall is likelier.
std::vector<Solution> CombinedSolver::search(std::span<const StageTask> tasks) {
  const bool falls_first = settings_.newton.skips.likely_falls;
  std::vector<StageTask> searched;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (falls_first && tasks[i].falls_likely) continue;
    searched.push_back(tasks[i]);
    places.push_back(i);
  }
  std::vector<Solution> found = newton_.solve(searched);
  std::vector<Solution> solutions(tasks.size());
  for (std::size_t k = 0; k < found.size(); ++k) solutions[places[k]] = std::move(found[k]);
  return solutions;
}

/// Takes the equilibria that Newton's method finds with all patience, from rest.
void CombinedSolver::insist(std::span<const StageTask> tasks, std::vector<Solution>& solutions) {
  std::vector<StageTask> open;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (solutions[i].outcome == Outcome::unresolved) {
      open.push_back(tasks[i]);
      open.back().start = nullptr;
      open.back().patiently = true;
      places.push_back(i);
    }
  std::vector<Solution> found = newton_.solve(open);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (stands(found[k])) solutions[places[k]] = std::move(found[k]);
}

/// Takes the equilibria that softer joints lead to, where Newton's method was asked and found none. True
/// where there are none but with joints as soft as motion has them: there motion would come to rest, too, and
/// could not say what happens with stiffer ones.
std::vector<bool> CombinedSolver::approach(std::span<const StageTask> tasks,
                                           std::vector<Solution>& solutions) {
  std::vector<bool> stand_softer(tasks.size(), false);
  if (!approaching_) return stand_softer;
  std::vector<StageTask> open;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (solutions[i].outcome != Outcome::unresolved || solutions[i].iterations == 0 || tasks[i].steps > 1)
      continue;
    open.push_back(tasks[i]);
    places.push_back(i);
  }
  std::vector<Approach> found =
      approach_from_softer_joints(*approaching_, *parameters_, settings_.softest_joints, open);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (stands(found[k].solution))
      solutions[places[k]] = std::move(found[k].solution);
    else
      stand_softer[places[k]] = found[k].reached >= motion_.stiffness_share();
  }
  return stand_softer;
}

/// Sets the scenes that are still open in motion, which begins with nothing slipped: takes the collapses,
/// polishes what rests; with all patience what rests for certain.
void CombinedSolver::follow(const DecisionRules& rules, std::span<const StageTask> tasks,
                            const std::vector<bool>& left_out, bool patiently,
                            std::vector<Solution>& solutions) {
  std::vector<std::size_t> open;
  std::vector<Scene> moving;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (solutions[i].outcome == Outcome::unresolved && tasks[i].before == nullptr && !left_out[i]) {
      open.push_back(i);
      moving.push_back(tasks[i].stage.scene);
    }
  std::vector<DynamicSolution> motions = motion_.solve(moving, rules);

  std::vector<StageTask> resting;
  std::vector<std::size_t> resting_at;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (motions[k].solution.outcome == Outcome::collapsed) {
      solutions[open[k]] = std::move(motions[k].solution);
    } else {
      const bool rests = patiently && motions[k].solution.outcome == Outcome::standing;
      resting.push_back(
          {.stage = tasks[open[k]].stage, .start = &motions[k].solution.displacement, .patiently = rests});
      resting_at.push_back(open[k]);
    }
  }
  std::vector<Solution> polished = newton_.solve(resting);
  for (std::size_t k = 0; k < polished.size(); ++k) solutions[resting_at[k]] = std::move(polished[k]);
}

}  // namespace voussoir
