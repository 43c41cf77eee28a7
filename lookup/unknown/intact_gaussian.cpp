#include "lookup/unknown/intact_gaussian.h"

#include <Eigen/Cholesky>

namespace voussoir {

Eigen::MatrixXd intact_covariance(const UnknownBridge& bridge, const CaseNoise& noise) {
  const Eigen::Index n = bridge.reading.size();
  const SceneLoss none{{}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const Eigen::MatrixXd scatter = bridge_columns(bridge, Scene{});
  return scene_noise(bridge, noise, none) + scatter * scatter.transpose();
}

std::vector<IntactGaussian> intact_gaussians(const UnknownBridge& bridge, const Observation& observation,
                                             std::span<const UnknownCase> cases) {
  const Eigen::Index n = bridge.reading.size();
  std::vector<IntactGaussian> result;
  for (const UnknownCase& one : cases) {
    const Eigen::LLT<Eigen::MatrixXd> covariance(
        intact_covariance(bridge, case_noise(bridge, observation, one)));
    IntactGaussian intact{one, covariance.solve(Eigen::MatrixXd::Identity(n, n)),
                          covariance.solve(bridge.reading)};
    const double log_root = covariance.matrixLLT().diagonal().array().log().sum();
    intact.log = -0.5 * bridge.reading.dot(intact.pulled) - log_root;
    result.push_back(std::move(intact));
  }
  return result;
}

}  // namespace voussoir
