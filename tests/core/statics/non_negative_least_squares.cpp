#include "core/statics/non_negative_least_squares.h"

#include <Eigen/QR>
#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "core/random.h"

using namespace voussoir;

namespace {

/// The least |a x - b| over all choices of unknowns that are not zero.
double least_by_brute_force(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  double least = b.norm();
  for (unsigned choice = 1; choice < (1U << a.cols()); ++choice) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < a.cols(); ++i)
      if ((choice >> i) & 1U) free.push_back(i);
    const Eigen::MatrixXd reduced = a(Eigen::all, free);
    const Eigen::VectorXd x = reduced.completeOrthogonalDecomposition().solve(b);
    if (x.minCoeff() >= 0.0) least = std::min(least, (reduced * x - b).norm());
  }
  return least;
}

}  // namespace

TEST_CASE("Least squares without negative unknowns are the best of all choices of unknowns (brute force)",
          "[solver]") {
  Random random(3);
  for (int problem = 0; problem < 200; ++problem) {
    const auto drawn = [&] { return 2.0 * random.uniform() - 1.0; };
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(4 + problem % 3, 7, drawn);
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(a.rows(), drawn);
    const Eigen::VectorXd x = non_negative_least_squares(a, b);
    const Eigen::VectorXd left = b - a * x;
    INFO(problem);
    CHECK(x.minCoeff() >= 0.0);
    CHECK(left.norm() == Approx(least_by_brute_force(a, b)).margin(1e-6));
    CHECK((a.transpose() * left).maxCoeff() < 1e-7);
    CHECK(left.dot(b) == Approx(left.squaredNorm()).margin(1e-7));
  }
}
