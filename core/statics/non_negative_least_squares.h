#pragma once
/// @file Least squares with unknowns that cannot be negative.

#include <Eigen/Core>

namespace voussoir {

/// The x >= 0 with the least |a x - b|, for a few hundred unknowns (Lawson and Hanson, Solving Least Squares
/// Problems, 1974, chapter 23). With r = b - a x: a^T r <= 0 but for round-off, and r . b = r . r.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace voussoir
