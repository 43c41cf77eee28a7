/// @file Oracles: subtraction by hand, the sum of variances.

#include "database/records/scene_change.h"

#include <catch2/catch.hpp>

namespace voussoir {
namespace {

Eigen::MatrixXd column(double a, double b, double c) {
  return Eigen::Vector3d(a, b, c);
}

}  // namespace

TEST_CASE("What a loss changes is the difference, and nothing where the block is gone") {
  const SceneFactors intact{column(1.0, 2.0, 3.0), column(4.0, 5.0, 6.0)};
  // The second point's block is gone; the third still moves with the epoch.
  const SceneFactors change = change_of({column(1.5, 0.0, 0.0), column(7.0, 0.0, 8.0)}, intact);
  CHECK(change.bridge == column(0.5, 0.0, -3.0));
  CHECK(change.epoch == column(3.0, 0.0, 2.0));
}

TEST_CASE("The bridge's factors alone can be known") {
  const Eigen::MatrixXd none(3, 0);
  const SceneFactors change = change_of({column(1.5, 0.0, 2.0), none}, {column(1.0, 2.0, 3.0), none});
  CHECK(change.bridge == column(0.5, 0.0, -1.0));
  CHECK(change.epoch.cols() == 0);
}

TEST_CASE("A widened signal has the variance of the signal and of both its errors") {
  const double factor = widening(0.3, 0.4);
  CHECK(factor * factor == Approx(1.0 + 0.09 + 0.16));
  CHECK(widening(0.0, 0.0) == 1.0);
}

}  // namespace voussoir
