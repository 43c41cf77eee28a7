#include "generator/unevenness.h"

#include "core/structure/uneven_stiffness.h"
#include "generator/covariance_factor.h"
#include "generator/scene_derivatives.h"

namespace voussoir {
namespace {

/// Derivatives of the points in all kept states, one below the other, by each pair's stiffness.
Eigen::MatrixXd derivatives_of(const SensitivityStudy& study, const UnevenStiffness& uneven,
                               const SceneStates& intact) {
  const std::vector<std::size_t> kept = kept_states(study.states);
  const auto points = static_cast<Eigen::Index>(study.bridge.control_points.size());
  const SensitivityEquations equations(study.bridge, {uneven.joints, {}, {}});
  SceneDerivatives derivatives(study, equations);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(kept.size()) * points,
                                              static_cast<Eigen::Index>(uneven.joints.size()));
  for (std::size_t state = 0; state < kept.size(); ++state) {
    const Eigen::MatrixXd own = derivatives.of({}, kept[state], intact, intact);
    if (own.size() > 0) all.middleRows(static_cast<Eigen::Index>(state) * points, points) = own;
  }
  return all;
}

}  // namespace

std::vector<Eigen::MatrixXd> find_unevenness(const SensitivityStudy& study, const SceneStates& intact) {
  const UnevenStiffness uneven = uneven_stiffness(study.bridge, study.uncertainty);
  if (uneven.joints.empty()) return {};
  const Eigen::MatrixXd derivatives = derivatives_of(study, uneven, intact);
  const Eigen::MatrixXd columns =
      covariance_factor(derivatives * uneven.correlations * derivatives.transpose());
  const auto points = static_cast<Eigen::Index>(study.bridge.control_points.size());
  std::vector<Eigen::MatrixXd> unevenness;
  for (Eigen::Index first = 0; first < columns.rows(); first += points)
    unevenness.emplace_back(columns.middleRows(first, points));
  return unevenness;
}

}  // namespace voussoir
