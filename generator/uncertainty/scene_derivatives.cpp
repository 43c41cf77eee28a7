#include "generator/uncertainty/scene_derivatives.h"

namespace voussoir {

SceneDerivatives::SceneDerivatives(const SensitivityStudy& study, const SensitivityEquations& equations)
    : equations_{equations.system, equations.coefficients, study.states,
                 [solver = study.solver.make_solver(study.bridge, study.settings)](const StageTask& task) {
                   return solver({&task, 1}).front();
                 }},
      readings_(equations.readings),
      derivatives_(equations.system, equations.uncertain) {}

std::optional<SolvedHistory> SceneDerivatives::history(const Scene& scene, std::size_t state,
                                                       const SceneStates& states,
                                                       const SceneStates& intact) const {
  return history_of_state(equations_, scene, state, states, intact);
}

Eigen::MatrixXd SceneDerivatives::of(const Scene& scene, std::size_t state, const SceneStates& states,
                                     const SceneStates& intact) {
  const auto steps = history(scene, state, states, intact);
  if (!steps) return {};
  return derivatives_.solve(*steps, readings_).value_or(Eigen::MatrixXd());
}

}  // namespace voussoir
