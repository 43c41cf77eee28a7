#include "lookup/unknown/leading_directions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "lookup/evidence/largest_places.h"

namespace voussoir {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kIterations = 2;  // the directions need not be exact

}  // namespace

MatrixXd leading_directions(const MatrixXd& covariance, Index count) {
  const VectorXd sizes = covariance.diagonal();
  MatrixXd basis =
      covariance(Eigen::all, largest_places({sizes.data(), static_cast<std::size_t>(sizes.size())},
                                            static_cast<std::size_t>(count)));
  const MatrixXd identity = MatrixXd::Identity(covariance.rows(), count);
  for (int i = 0; i < kIterations; ++i)
    basis = covariance * (Eigen::HouseholderQR<MatrixXd>(basis).householderQ() * identity);
  const MatrixXd orthonormal = Eigen::HouseholderQR<MatrixXd>(basis).householderQ() * identity;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> within(orthonormal.transpose() * covariance * orthonormal);
  return orthonormal * within.eigenvectors().rowwise().reverse();
}

}  // namespace voussoir
