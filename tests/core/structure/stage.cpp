/// @file The way from one stage to another. Oracle: numbers by hand.

#include "core/structure/stage.h"

#include <catch2/catch.hpp>

namespace voussoir {

TEST_CASE(
    "On the way all but the scene has gone its share (by "
    "hand)") {
  Stage warm{.scene = {{BlockId{3}}}, .load = Field::Constant(2, 2, 7.0), .temperature = 10.0};
  Stage moved{.gravity_share = 0.5,
              .temperature = -2.0,
              .uneven_temperature = Eigen::ArrayXd::Constant(4, 8.0),
              .support_movement = Field::Constant(2, 2, 4e-3),
              .joint_stiffness = Eigen::ArrayXd::Constant(3, 0.0625)};
  const Stage to_moved = on_the_way(warm, moved, 0.25);
  CHECK(to_moved.temperature == Approx(7.0));
  CHECK(to_moved.uneven_temperature.isApprox(Eigen::ArrayXd::Constant(4, 2.0)));
  CHECK(temperature_of(to_moved, 3) == Approx(9.0));
  CHECK(to_moved.support_movement.isApprox(Field::Constant(2, 2, 1e-3)));
  REQUIRE(to_moved.joint_stiffness.size() == 3);
  CHECK(to_moved.joint_stiffness.isApprox(Eigen::ArrayXd::Constant(3, 0.5)));
  CHECK(on_the_way({}, warm, 0.25).joint_stiffness.size() == 0);
  CHECK(to_moved.scene == Scene{});
  CHECK(to_moved.load.isApprox(Field::Constant(2, 2, 5.25)));
  CHECK(to_moved.gravity_share == Approx(0.875));
  const Stage to_warm = on_the_way(moved, warm, 0.25);
  CHECK(to_warm.temperature == Approx(1.0));
  CHECK(to_warm.support_movement.isApprox(Field::Constant(2, 2, 3e-3)));
  CHECK(to_warm.scene == warm.scene);
  CHECK(to_warm.load.isApprox(Field::Constant(2, 2, 1.75)));
  CHECK(on_the_way({}, warm, 0.5).support_movement.size() == 0);
}

}  // namespace voussoir
