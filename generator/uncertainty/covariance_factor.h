#pragma once
/// @file Columns that have a given covariance.

#include <Eigen/Eigenvalues>

namespace voussoir {

/// F with F F^T = covariance, along its principal directions; what rounding made negative is zero.
inline Eigen::MatrixXd covariance_factor(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(covariance);
  return directions.eigenvectors() * directions.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace voussoir
