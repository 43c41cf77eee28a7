#include "tools/benchmarks/default_build.h"

namespace voussoir {
namespace {

StageSolver default_solver(const Model& model, const PlanRules& rules) {
  const SolverChoice choice = quasi_static_with(rules.collapse_fields);
  return choice.make_solver(model, choice.settings(model));
}

}  // namespace

DefaultBuild::DefaultBuild(const BridgeDescription& description, const Model& model)
    : plan_({PlannedState{.name = "built"}}),
      rules_{.collapse_fields = keeps_collapse_fields(description, model)},
      solver_(default_solver(model, rules_)),
      states_(model, plan_),
      basis_(states_.basis(solver_, {}, rules_)) {}

Solution DefaultBuild::solve_intact() {
  Solution intact = std::move(solve(std::vector<Scene>(1)).front());
  StartingFields starts;
  starts.add({}, kBuilt, intact);
  basis_ = states_.basis(solver_, std::move(starts), rules_);
  return intact;
}

std::vector<Solution> DefaultBuild::solve(std::span<const Scene> scenes) const {
  std::vector<SceneGroup> groups;
  for (const Scene& scene : scenes) groups.push_back({.solved = scene, .states = {}, .image = {}});
  states_.solve(solver_, basis_, groups);
  std::vector<Solution> solutions;
  for (SceneGroup& group : groups) solutions.push_back(std::move(*group.states.front()));
  return solutions;
}

}  // namespace voussoir
