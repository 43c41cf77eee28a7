#include "lookup/unknown/leading_directions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <vector>

namespace voussoir {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kIterations = 2;  // the directions need not be exact

}  // namespace

MatrixXd leading_directions(const MatrixXd& covariance, Index count) {
  const VectorXd sizes = covariance.diagonal();
  std::vector<Index> order(static_cast<std::size_t>(sizes.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return sizes[a] > sizes[b]; });
  MatrixXd basis(covariance.rows(), count);
  for (Index k = 0; k < count; ++k) basis.col(k) = covariance.col(order[static_cast<std::size_t>(k)]);
  const MatrixXd identity = MatrixXd::Identity(covariance.rows(), count);
  for (int i = 0; i < kIterations; ++i)
    basis = covariance * (Eigen::HouseholderQR<MatrixXd>(basis).householderQ() * identity);
  const MatrixXd orthonormal = Eigen::HouseholderQR<MatrixXd>(basis).householderQ() * identity;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> within(orthonormal.transpose() * covariance * orthonormal);
  return orthonormal * within.eigenvectors().rowwise().reverse();
}

}  // namespace voussoir
