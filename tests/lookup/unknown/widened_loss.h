#pragma once
/// @file Oracle: what a loss changes in how displacements depend on what is uncertain, from its definition.

#include <cmath>

#include "database/records/sensitivities.h"

namespace voussoir::test {

/// Columns of an epoch: its parameters, and what these leave in sampled bridges.
inline Eigen::MatrixXd epoch_columns_of(const FactorsView& scene) {
  Eigen::MatrixXd columns(scene.epoch.rows(), scene.epoch.cols() + scene.left.cols());
  columns << scene.epoch, scene.left;
  return columns;
}

/// Of a scene with factors of its own, to first order and with what that leaves along it; of an epoch as far
/// as no sampled bridge shows it. Nothing at points whose block is gone.
inline SceneFactors widened_loss(const Sensitivities& from, const Scene& scene) {
  const FactorsView intact = from.find(0, {}).value(), own = from.find(0, scene).value();
  const FirstOrderResidual& residual = from.residuals[0];
  SceneFactors loss{own.bridge - intact.bridge, own.epoch - intact.epoch};
  for (Eigen::Index i = 0; i < loss.bridge.rows(); ++i)
    if (own.bridge.row(i).isZero()) {
      loss.bridge.row(i).setZero();
      loss.epoch.row(i).setZero();
    }
  double not_shown = 1.0;
  for (Eigen::Index j = 0; j < own.left.cols(); ++j)
    if (own.left.col(j).norm() > 0.0) not_shown -= 1.0 / static_cast<double>(own.left.cols());
  const auto widen = [](Eigen::MatrixXd& columns, double share, double common) {
    columns *= std::sqrt(1.0 + share * share + common * common);
  };
  widen(loss.bridge, residual.share, residual.common);
  widen(loss.epoch, std::sqrt(not_shown) * residual.epoch_share,
        std::sqrt(not_shown) * residual.epoch_common);
  Eigen::MatrixXd columns(loss.epoch.rows(), loss.epoch.cols() + own.left.cols());
  columns << loss.epoch, own.left;
  loss.epoch = columns;
  return loss;
}

}  // namespace voussoir::test
