#include "lookup/unknown/intact_gaussian.h"

#include <Eigen/Cholesky>

namespace voussoir {

Eigen::MatrixXd intact_covariance(const UnknownBridge& bridge) {
  const Eigen::Index n = bridge.reading.size();
  const SceneLoss none{{}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const Eigen::MatrixXd scatter = bridge_columns(bridge, Scene{});
  return scene_noise(bridge, none) + scatter * scatter.transpose();
}

IntactGaussian intact_gaussian(const UnknownBridge& bridge) {
  const Eigen::Index n = bridge.reading.size();
  const Eigen::LLT<Eigen::MatrixXd> covariance(intact_covariance(bridge));
  IntactGaussian result{covariance.solve(Eigen::MatrixXd::Identity(n, n)), covariance.solve(bridge.reading)};
  const double log_root = covariance.matrixLLT().diagonal().array().log().sum();
  result.log = -0.5 * bridge.reading.dot(result.pulled) - log_root;
  return result;
}

}  // namespace voussoir
