#include "core/solve/movements.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

/// Two courses of the Eindhoven wall between its beams.
BridgeDescription low_wall() {
  BridgeDescription wall = read_bridge_file(test::example_bridge("eindhoven-wall")).description;
  wall.wall.courses = 4;
  wall.mesh.refinement = 0;
  wall.movements.back().x = 1e-3;
  return wall;
}

}  // namespace

TEST_CASE("A wall is pressed as told, then slides at c + mu p at most (closed forms)", "[mortar][path]") {
  const BridgeDescription wall = low_wall();
  const MovedStructure moved = follow_movements(make_model(wall), wall.movements);
  REQUIRE(moved.complete);
  constexpr double kArea = 0.99 * 0.1;
  CHECK(moved.points.front().force.y() == Approx(-0.3e6 * kArea).epsilon(1e-5));
  CHECK(std::abs(moved.points.front().force.x()) < 1e-3 * 0.3e6 * kArea);
  double strongest = 0.0;
  double pressure = 0.0;
  for (const MovedPoint& point : moved.points) {
    strongest = std::max(strongest, point.force.x());
    pressure = std::max(pressure, -point.force.y() / kArea);
  }
  CHECK(strongest < (0.35e6 + 0.75 * pressure) * kArea);
  CHECK(strongest > 0.7 * (0.35e6 + 0.75 * 0.3e6) * kArea);
  CHECK(moved.points.back().moved.x() == Approx(1e-3));
  CHECK(moved.points.back().at.dissipated > 0.0);
}

TEST_CASE("A movement of a support that does not exist is refused with those that do", "[path]") {
  BridgeDescription wall = low_wall();
  wall.movements.front().support = "roof";
  CHECK_THROWS_WITH(follow_movements(make_model(wall), wall.movements),
                    "support in [[movements]]: 'roof' does not exist: expected one of foot 1, top");
}
