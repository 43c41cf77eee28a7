#include "generator/uncertainty/joint_factors.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

/// Directions with less of the largest one's variance than this are rounding.
constexpr double kRounding = 1e-12;

/// The errors side by side, over the roots of how many there are in each state: state after state x bridges.
Eigen::MatrixXd stacked(const std::vector<StateErrors>& errors, Eigen::Index points) {
  const auto bridges = static_cast<Eigen::Index>(errors.front().size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(errors.size()) * points, bridges);
  for (std::size_t s = 0; s < errors.size(); ++s) {
    const auto standing =
        std::ranges::count_if(errors[s], [](const auto& error) { return error.size() > 0; });
    for (Eigen::Index b = 0; b < bridges; ++b)
      if (const Eigen::VectorXd& error = errors[s][static_cast<std::size_t>(b)]; error.size() > 0)
        all.col(b).segment(static_cast<Eigen::Index>(s) * points, points) =
            error / std::sqrt(static_cast<double>(standing));
  }
  return all;
}

/// The same covariance in as many columns as it has directions, the largest first.
Eigen::MatrixXd principal_columns(const Eigen::MatrixXd& columns) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(columns.transpose() * columns);
  const Eigen::VectorXd& variances = directions.eigenvalues();  // ascending
  const double least = kRounding * variances.tail<1>()[0];
  const Eigen::Index kept = std::max<Eigen::Index>(1, (variances.array() > least).count());
  return (columns * directions.eigenvectors().rightCols(kept)).rowwise().reverse();
}

}  // namespace

std::vector<Eigen::MatrixXd> joint_factors(const std::vector<StateErrors>& errors, Eigen::Index points) {
  if (errors.front().empty()) return {errors.size(), Eigen::MatrixXd::Zero(points, 1)};
  const Eigen::MatrixXd columns = principal_columns(stacked(errors, points));
  std::vector<Eigen::MatrixXd> factors;
  for (Eigen::Index s = 0; s < static_cast<Eigen::Index>(errors.size()); ++s)
    factors.push_back(columns.middleRows(s * points, points));
  return factors;
}

}  // namespace voussoir
