#include "core/statics/non_negative_least_squares.h"

#include <Eigen/Cholesky>
#include <vector>

namespace voussoir {
namespace {

/// Of the largest gradient: what is less is round-off.
constexpr double kNoSlope = 1e-9;
/// Of the largest diagonal entry, added to all: columns of joints that share a line depend on each other.
constexpr double kRegular = 1e-13;

/// The normal equations, and which unknowns are free to be positive.
struct FreeSet {
  Eigen::MatrixXd matrix;  ///< a^T a
  Eigen::VectorXd right;   ///< a^T b
  std::vector<Eigen::Index> free{};

  /// The least squares of the free unknowns, without bounds.
  Eigen::VectorXd solve() const {
    Eigen::MatrixXd reduced = matrix(free, free);
    reduced.diagonal().array() += kRegular * matrix.diagonal().maxCoeff();
    return reduced.llt().solve(right(free));
  }
};

/// Goes from x as far towards the free unknowns' own least squares as none becomes negative; those that come
/// to zero are free no more. True if that is the whole way.
bool go_towards_least_squares(FreeSet& set, Eigen::VectorXd& x) {
  const Eigen::VectorXd target = set.solve();
  double share = 1.0;
  for (std::size_t i = 0; i < set.free.size(); ++i) {
    const double from = x[set.free[i]];
    const double to = target[static_cast<Eigen::Index>(i)];
    if (to <= 0.0) share = std::min(share, from / (from - to));
  }
  std::vector<Eigen::Index> still_free;
  for (std::size_t i = 0; i < set.free.size(); ++i) {
    double& value = x[set.free[i]];
    const double to = target[static_cast<Eigen::Index>(i)];
    const bool ends = to <= 0.0 && value / (value - to) <= share;
    value = ends ? 0.0 : value + share * (to - value);
    if (!ends) still_free.push_back(set.free[i]);
  }
  set.free = std::move(still_free);
  return share == 1.0;
}

}  // namespace

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  FreeSet set{a.transpose() * a, a.transpose() * b};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  if (a.cols() == 0) return x;
  const double least = kNoSlope * set.right.cwiseAbs().maxCoeff();
  // Each unknown is let free once in the usual course; the bound only ends a cycle of round-off.
  for (Eigen::Index round = 0; round < 10 * a.cols(); ++round) {
    Eigen::VectorXd gradient = set.right - set.matrix * x;
    for (const Eigen::Index i : set.free) gradient[i] = 0.0;
    Eigen::Index steepest = 0;
    if (!(gradient.maxCoeff(&steepest) > least)) break;
    set.free.push_back(steepest);
    while (!set.free.empty() && !go_towards_least_squares(set, x)) {
    }
  }
  return x;
}

}  // namespace voussoir
