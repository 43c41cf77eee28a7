#include "generator/scenes/solvers.h"

#include <memory>

#include "core/solve/combined_solver.h"
#include "core/solve/outcomes_only.h"

namespace voussoir {
namespace {

constexpr double kSlowRamp = 2.0;  ///< [s] in which gravity grows; some periods of the longest bridges

StageSolver combined_solver(const SolverSettings& settings, const Model& model) {
  const auto solver = std::make_shared<CombinedSolver>(model, settings);
  return [solver](std::span<const StageTask> tasks) { return solver->solve(tasks); };
}

StageSolver dynamic_solver(const SolverSettings& settings, const Model& model) {
  const auto solver = std::make_shared<DynamicSolver>(model, settings.motion);
  return [solver](std::span<const StageTask> tasks) {
    std::vector<Scene> scenes;
    for (const StageTask& task : tasks) scenes.push_back(task.stage.scene);
    std::vector<Solution> solutions;
    for (DynamicSolution& motion : solver->solve(scenes)) solutions.push_back(std::move(motion.solution));
    return solutions;
  };
}

StageSolver acting_solver(const SolverSettings& settings, const Model& model) {
  return settings.kind == SolverKind::dynamic ? dynamic_solver(settings, model)
                                              : combined_solver(settings, model);
}

}  // namespace

StageSolver stated_solver(const Model& model, const std::string& settings) {
  return acting_solver(parse_settings(settings), model);
}

SolverChoice solver_with(const SolverSettings& settings) {
  SolverSettings slow = settings;
  slow.motion.ramp = kSlowRamp;
  return {[settings](const Model& model) { return to_text(acting_settings(settings, model)); },
          [settings](const Model& model, const std::string& stated) {
            return acting_solver(parse_settings(stated, settings), model);
          },
          [settings](const Model& model) {
            const auto solver =
                std::make_shared<QuasiStaticSolver>(model, acting_settings(settings, model).newton);
            return [solver](std::span<const StageTask> tasks) { return solver->solve(tasks); };
          },
          [slow](const Model& model) { return acting_solver(acting_settings(slow, model), model); }};
}

SolverChoice quasi_static(const DynamicSettings& motion) {
  return solver_with(SolverSettings::of(SolverKind::quasi_static, motion));
}

SolverChoice for_outcomes(const DynamicSettings& motion) {
  SolverChoice choice = quasi_static(motion);
  choice.settings = [settings = SolverSettings::of(SolverKind::quasi_static, motion)](const Model& model) {
    return to_text(acting_settings(for_outcomes(settings, model), model));
  };
  return choice;
}

SolverChoice quasi_static_with(bool collapse_fields, const DynamicSettings& motion) {
  return collapse_fields ? quasi_static(motion) : for_outcomes(motion);
}

bool keeps_collapse_fields(const BridgeDescription& description, const Model& bridge,
                           const DynamicSettings& motion) {
  return description.collapse_fields && !softens_joints(motion, bridge);
}

SolverChoice dynamic(const DynamicSettings& motion) {
  return solver_with(SolverSettings::of(SolverKind::dynamic, motion));
}

}  // namespace voussoir
