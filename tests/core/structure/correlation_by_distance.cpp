/// @file Oracle: the correlation's definition by hand.

#include "core/structure/correlation_by_distance.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/bridges.h"

using namespace voussoir;

TEST_CASE("Things are alike as far as they are near each other (by hand)", "[uncertainty]") {
  const Model bridge = test::reference_bridge();
  const Eigen::MatrixXd found = correlations_by_distance(bridge, {{1.0, 2.0}, {4.0, 6.0}, {1.0, 3.0}});
  CHECK(found(0, 1) == Approx(std::exp(-1.0)));  // 5 m, a quarter of 20 m
  CHECK(found(0, 2) == Approx(std::exp(-0.2)));
  CHECK(found == found.transpose());
  CHECK(found.diagonal().isOnes(0.0));
  CHECK(correlations_by_distance(bridge, {}).size() == 0);
}
