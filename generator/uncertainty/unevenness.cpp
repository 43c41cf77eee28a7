#include "generator/uncertainty/unevenness.h"

#include <Eigen/Eigenvalues>

#include "core/structure/unevenness.h"
#include "generator/uncertainty/scene_derivatives.h"

namespace voussoir {
namespace {

/// Derivatives of the points in all kept states, one below the other, by each uneven quantity in the order of
/// the actions.
Eigen::MatrixXd derivatives_of(const SensitivityStudy& study, const std::vector<UncertainAction>& actions,
                               const SceneStates& intact) {
  const std::vector<std::size_t> kept = kept_states(study.states);
  const auto points = static_cast<Eigen::Index>(study.bridge.control_points.size());
  const SensitivityEquations equations(study.bridge, {actions, {}, {}});
  SceneDerivatives derivatives(study, equations);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(kept.size()) * points,
                                              static_cast<Eigen::Index>(actions.size()));
  for (std::size_t state = 0; state < kept.size(); ++state) {
    const Eigen::MatrixXd own = derivatives.of({}, kept[state], intact, intact);
    if (own.size() > 0) all.middleRows(static_cast<Eigen::Index>(state) * points, points) = own;
  }
  return all;
}

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& derivatives, const Eigen::MatrixXd& correlations) {
  return derivatives * correlations * derivatives.transpose();
}

/// F with F F^T = covariance, along its principal directions; what rounding made negative is zero.
Eigen::MatrixXd covariance_factor(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(covariance);
  return directions.eigenvectors() * directions.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace

std::vector<Eigen::MatrixXd> find_unevenness(const SensitivityStudy& study, const SceneStates& intact) {
  const Unevenness uneven = unevenness_of(study.bridge, study.description.uncertainty);
  if (uneven.is_none()) return {};
  std::vector<UncertainAction> actions = uneven.stiffness.actions;
  actions.insert(actions.end(), uneven.temperature.actions.begin(), uneven.temperature.actions.end());
  const Eigen::MatrixXd derivatives = derivatives_of(study, actions, intact);
  const Eigen::MatrixXd columns =
      covariance_factor(covariance_of(derivatives.leftCols(uneven.stiffness.correlations.rows()),
                                      uneven.stiffness.correlations) +
                        covariance_of(derivatives.rightCols(uneven.temperature.correlations.rows()),
                                      uneven.temperature.correlations));
  const auto points = static_cast<Eigen::Index>(study.bridge.control_points.size());
  std::vector<Eigen::MatrixXd> unevenness;
  for (Eigen::Index first = 0; first < columns.rows(); first += points)
    unevenness.emplace_back(columns.middleRows(first, points));
  return unevenness;
}

}  // namespace voussoir
