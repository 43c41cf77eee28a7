#include "generator/verify/sensitivity_check.h"

#include <algorithm>

#include "core/error.h"
#include "database/records/stored_bridge.h"
#include "generator/uncertainty/load_influence.h"
#include "generator/uncertainty/scene_derivatives.h"
#include "generator/uncertainty/unevenness.h"

namespace voussoir {
namespace {

double largest(const Eigen::MatrixXd& matrix) {
  return matrix.size() == 0 ? 0.0 : matrix.cwiseAbs().maxCoeff();
}

/// By the covariance of all states: its factor's columns may be turned.
bool is_same_unevenness(const std::vector<Eigen::MatrixXd>& found,
                        const std::vector<Eigen::MatrixXd>& expected) {
  if (found.size() != expected.size()) return false;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const Eigen::MatrixXd right = expected[i] * expected[j].transpose();
      if (found[i].rows() != expected[i].rows() || found[j].rows() != expected[j].rows() ||
          largest(found[i] * found[j].transpose() - right) > kSameSensitivity * largest(right))
        return false;
    }
  return true;
}

bool is_same_influence(const LoadInfluence& found, const LoadInfluence& expected) {
  return found.places == expected.places && found.readings.rows() == expected.readings.rows() &&
         largest(found.readings - expected.readings) <= kSameSensitivity * largest(expected.readings);
}

std::vector<std::string> problems_of_intact(const Sensitivities& stored, const SensitivityStudy& study,
                                            const SensitivityEquations& equations,
                                            const SceneStates& intact) {
  std::vector<std::string> problems;
  if (!is_same_unevenness(stored.unevenness, find_unevenness(study, intact)))
    problems.push_back("what differs from part to part of the intact bridge is not that of its field");
  if (!is_same_influence(stored.load, find_load_influence(study, equations, intact)))
    problems.push_back("what a load adds to the intact bridge's readings is not that of its field");
  return problems;
}

}  // namespace

SensitivityCheck check_sensitivities(const Database& database, const Model& bridge,
                                     const BridgeDescription& description, const StatePlan& plan) {
  SensitivityCheck check;
  const Sensitivities* stored = database.sensitivities();
  const auto intact_row = database.find(Scene{});
  if (stored == nullptr || !intact_row || !database.has_fields() || kept_states(plan).size() != plan.size())
    return check;
  const std::string settings = database.provenance().solver_settings;
  const SolverChoice solver{.settings = {}, .make_solver = stated_solver};
  const SensitivityStudy study{description, bridge, plan, solver, settings};
  const SensitivityEquations equations(bridge, uncertain_parameters(bridge, description.uncertainty));
  SceneDerivatives derivatives(study, equations);
  const SceneStates intact = stored_states(database, *intact_row, plan);
  check.problems = problems_of_intact(*stored, study, equations, intact);
  const std::size_t count = std::min(kCheckedSensitivities, stored->scenes.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Scene& scene = stored->scenes[i * stored->scenes.size() / count];
    const auto row = database.find(scene);
    if (!row) continue;
    ++check.scenes;
    const SceneStates states = stored_states(database, *row, plan);
    for (std::size_t state = 0; state < plan.size(); ++state) {
      // Sensitivities of an uncertain fall are of other bridges.
      if (stored->find_fall(state, scene) && !(states[state] && stands(*states[state]))) continue;
      const Eigen::MatrixXd anew = derivatives.of(scene, state, states, intact);
      const auto factors = stored->find(state, scene);
      const bool is_same =
          factors.has_value() == (anew.size() > 0) &&
          (!factors || (anew.cols() == stored->of_bridge() + stored->of_epoch() &&
                        largest(anew.leftCols(stored->of_bridge()) * stored->basis - factors->bridge) <=
                            kSameSensitivity * largest(factors->bridge) &&
                        largest(anew.rightCols(stored->of_epoch()) - factors->epoch) <=
                            kSameSensitivity * largest(factors->epoch)));
      if (!is_same)
        check.problems.push_back(fmt::format("scene {}: its sensitivities {} are not those of its field",
                                             to_string(scene, bridge.layout), database.states()[state]));
    }
  }
  return check;
}

}  // namespace voussoir
