#pragma once
/// @file Whether what was drawn at random varies together as it should.

#include <Eigen/Core>

namespace voussoir::test {

/// How far the covariance of draws (a column a draw, of mean 0) is from the stated one, at most, in standard
/// errors.
inline double worst_covariance_error(const Eigen::MatrixXd& drawn, const Eigen::MatrixXd& stated) {
  const auto draws = static_cast<double>(drawn.cols());
  const Eigen::MatrixXd found = drawn * drawn.transpose() / draws;
  const Eigen::VectorXd variances = stated.diagonal();
  const Eigen::MatrixXd products = variances * variances.transpose();
  return ((found - stated).array().abs() / ((products.array() + stated.array().square()) / draws).sqrt())
      .maxCoeff();
}

}  // namespace voussoir::test
