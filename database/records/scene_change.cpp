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

}  // namespace voussoir
