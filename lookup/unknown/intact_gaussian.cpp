#include "lookup/unknown/intact_gaussian.h"

#include <Eigen/Cholesky>

namespace voussoir {

IntactGaussian intact_gaussian(const UnknownBridge& bridge) {
  const Eigen::Index n = bridge.reading.size();
  const SceneLoss none{{}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const Eigen::MatrixXd scatter = bridge_columns(bridge, Scene{});
  const Eigen::LLT<Eigen::MatrixXd> covariance(scene_noise(bridge, none) + scatter * scatter.transpose());
  IntactGaussian result{covariance.solve(Eigen::MatrixXd::Identity(n, n)),
                        covariance.solve(bridge.reading)};
  const double log_root = covariance.matrixLLT().diagonal().array().log().sum();
  result.log = -0.5 * bridge.reading.dot(result.pulled) - log_root;
  return result;
}

}  // namespace voussoir
