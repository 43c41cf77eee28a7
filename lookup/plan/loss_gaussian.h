#pragma once
/// @file Readings before they are taken, as one Gaussian for the loss of each block.

#include <optional>
#include <vector>

#include "lookup/unknown/case_noise.h"

namespace voussoir {

/// N(signal, covariance) in rows of y.
struct LossGaussian {
  Eigen::VectorXd signal;      ///< [m] NaN where the block takes the sensor with it
  Eigen::MatrixXd covariance;  ///< [m2] of the other rows
};

/// Of the loss of one block that has sensitivities, or of none.
LossGaussian loss_gaussian(const UnknownBridge& bridge, const CaseNoise& noise, std::optional<BlockId> lost);

/// The blocks without which the bridge stands and has sensitivities, ascending.
std::vector<BlockId> blocks_with_sensitivities(const UnknownBridge& bridge);

/// The rows that are read although this is lost.
std::vector<Eigen::Index> rows_with_reading(const Eigen::VectorXd& signal);

}  // namespace voussoir
