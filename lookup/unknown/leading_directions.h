#pragma once
/// @file In which directions most of a covariance lies.

#include <Eigen/Core>

namespace voussoir {

/// The leading eigenvectors of a covariance, nearly: orthonormal columns, the largest first.
Eigen::MatrixXd leading_directions(const Eigen::MatrixXd& covariance, Eigen::Index count);

}  // namespace voussoir
