#include "core/statics/broyden.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace voussoir;

namespace {

/// A root to be found with an old matrix.
struct Problem {
  Eigen::Matrix4d matrix, old;
  Eigen::Vector4d right;

  Problem() {
    old << 4, 1, 0, 0, 1, 5, 1, 0, 0, 1, 6, 1, 0, 0, 1, 7;
    matrix = old;
    matrix(0, 0) = 2.5;  // as if two joints had opened since
    matrix(2, 3) = -0.5;
    right << 1, -2, 3, 0.5;
  }
  Eigen::Vector4d unbalance(const Eigen::Vector4d& x) const { return right - matrix * x; }
};

}  // namespace

TEST_CASE("Broyden's steps are those of the dense matrix with its rank-one updates (brute force)",
          "[solver]") {
  const Problem problem;
  BroydenSecants secants;
  Eigen::Matrix4d dense = problem.old;
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector4d r = problem.unbalance(x);
    const Eigen::VectorXd step = secants.step(problem.old.lu().solve(r));
    const Eigen::Vector4d expected = dense.lu().solve(r);
    INFO(i);
    CHECK((step - expected).norm() < 1e-12 * expected.norm());
    x += step;
    // The unbalance falls by B s where the matrix is right; the update makes up for what is left.
    dense -= problem.unbalance(x) * step.transpose() / step.squaredNorm();
    secants.add(step);
  }
  CHECK(secants.size() == 5);
}

TEST_CASE("Without steps taken the answer of the old matrix is left as it is", "[solver]") {
  BroydenSecants secants;
  const Eigen::VectorXd solution = Eigen::VectorXd::LinSpaced(4, 1.0, 2.0);
  secants.add(10.0 * Eigen::VectorXd::Ones(4));
  CHECK(secants.step(solution) != solution);
  secants.clear();
  CHECK(secants.step(solution) == solution);
}
