#include "tools/default_build.h"

#include "core/motion/dynamic_solver.h"

namespace voussoir {
namespace {

/// Fields of what falls are kept where motion can follow the joints as they are.
PlanRules default_rules(const Model& model) {
  PlanRules rules;
  rules.collapse_fields = !softens_joints({}, model);
  return rules;
}

SceneSolver default_solver(const Model& model, bool collapse_fields) {
  const SolverChoice choice = collapse_fields ? quasi_static() : for_outcomes();
  return choice.make_solver(model, choice.settings(model));
}

}  // namespace

DefaultBuild::DefaultBuild(const Model& model)
    : plan_({PlannedState{.name = "built"}}),
      rules_(default_rules(model)),
      solver_(default_solver(model, rules_.collapse_fields)),
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
