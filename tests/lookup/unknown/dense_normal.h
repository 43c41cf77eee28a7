#pragma once
/// @file The multivariate normal, written down from its definition and factorised by Eigen (LDLT): the oracle
/// of evidence under covariances.

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

namespace voussoir::test {

inline double log_normal(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance) {
  const Eigen::LDLT<Eigen::MatrixXd> factorised(covariance);
  return -0.5 * (static_cast<double>(difference.size()) * std::log(2.0 * std::numbers::pi) +
                 factorised.vectorD().array().log().sum() + difference.dot(factorised.solve(difference)));
}

}  // namespace voussoir::test
