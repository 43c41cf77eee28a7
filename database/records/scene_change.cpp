#include "database/records/scene_change.h"

#include <cmath>

namespace voussoir {

SceneFactors change_of(SceneFactors scene, const SceneFactors& intact) {
  const Eigen::VectorXd sizes =
      scene.bridge.cwiseAbs().rowwise().sum() + scene.epoch.cwiseAbs().rowwise().sum();
  const Eigen::VectorXd there = (sizes.array() > 0.0).cast<double>();
  scene.bridge -= there.asDiagonal() * intact.bridge;
  scene.epoch -= there.asDiagonal() * intact.epoch;
  return scene;
}

double widening(double share, double common) {
  return std::sqrt(1.0 + std::pow(share, 2) + std::pow(common, 2));
}

double widening_of_epoch(const FirstOrderResidual& residual, const Eigen::Ref<const Eigen::MatrixXd>& left) {
  const Eigen::Index bridges = left.cols(), shown = (left.array() != 0.0).colwise().any().count();
  const double not_shown =
      bridges == 0 ? 1.0 : 1.0 - static_cast<double>(shown) / static_cast<double>(bridges);
  const double root = std::sqrt(not_shown);
  return widening(root * residual.epoch_share, root * residual.epoch_common);
}

}  // namespace voussoir
