/// @file Oracle: the correlation's definition by hand.

#include "core/structure/joint_correlation.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/bridges.h"

using namespace voussoir;

TEST_CASE("Joints are alike as far as they are near each other (by hand)", "[uncertainty]") {
  const Model bridge = test::reference_bridge();
  const std::vector<std::size_t> joints = {3, 200, 7};
  const Eigen::MatrixXd found = joint_correlations(bridge, joints);
  const auto place = [&](std::size_t joint) {
    const auto ends = ends_of(bridge.joints[joint], bridge.mesh);
    return Point(0.5 * (ends[0] + ends[1]));
  };
  const double distance = (place(3) - place(200)).norm();
  REQUIRE(distance > 1.0);
  CHECK(found(0, 1) == Approx(std::exp(-distance / 5.0)));  // a quarter of 20 m
  CHECK(found == found.transpose());
  CHECK(found.diagonal().isOnes(0.0));
  CHECK(joint_correlations(bridge, {}).size() == 0);
}
