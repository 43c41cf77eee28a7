#include "core/solve/combined_solver.h"

namespace voussoir {

CombinedSolver::CombinedSolver(const Model& model, const SolverSettings& settings)
    : settings_(settings),
      newton_(model, settings.newton),
      motion_(model, newton_.system(), settings.motion),
      moves_(!has_mortar(model.parameters)) {}

std::vector<Solution> CombinedSolver::solve(std::span<const StageTask> tasks) {
  std::vector<Solution> solutions = search(tasks);
  if (!moves_) return solutions;
  follow(settings_.motion.decision, tasks, false, solutions);
  follow(settings_.patient, tasks, true, solutions);
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

/// Sets the scenes that are still open in motion, which begins with nothing slipped: takes the collapses,
/// polishes what rests; with all patience what rests for certain.
void CombinedSolver::follow(const DecisionRules& rules, std::span<const StageTask> tasks, bool patiently,
                            std::vector<Solution>& solutions) {
  std::vector<std::size_t> open;
  std::vector<Scene> moving;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (solutions[i].outcome == Outcome::unresolved && tasks[i].before == nullptr) {
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
      resting.push_back({.stage = tasks[open[k]].stage,
                         .start = &motions[k].solution.displacement,
                         .stands_likely = rests});
      resting_at.push_back(open[k]);
    }
  }
  std::vector<Solution> polished = newton_.solve(resting);
  for (std::size_t k = 0; k < polished.size(); ++k) solutions[resting_at[k]] = std::move(polished[k]);
}

}  // namespace voussoir
