#include "tools/validation/movements.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using namespace voussoir::validation;

namespace {

/// The shear force by which a wall of courses between two clamped beams moves by 1 m, from above and from
/// below, by the theorems of least energy [N/m].
struct StiffnessBounds {
  double least, greatest;
};

/// Least: the complementary energy of a beam's stresses (linear in x for the moment, parabolic for the shear,
/// none sideways), which are in equilibrium. Greatest: the energy of courses that stay rigid.
StiffnessBounds stiffness_bounds(const BridgeDescription& wall) {
  constexpr double kMiddles = 1e13;  // [Pa/m] stiffness of the middles of bricks
  const double b = wall.wall.length, h = wall.wall.course_height, t = wall.material.thickness;
  const double inertia = t * b * b * b / 12.0, area = b * t;
  const int acting = wall.wall.courses - 2 * wall.supports.embedded_courses;
  const double height = acting * h;
  double bed_bending = 0.0;  // by a unit of force
  for (int joint = 0; joint <= acting; ++joint)
    bed_bending += std::pow(joint * h - 0.5 * height, 2) / (wall.joints.normal_stiffness * inertia);
  const double bed_shear = (acting + 1) / (wall.joints.tangential_stiffness * area);
  double upright = 0.0;  // joints and middles of bricks, half a brick apart; in the next course they change
  for (double x = 0.5 * wall.wall.block_length; x < b - 1e-9; x += 0.5 * wall.wall.block_length) {
    const double shear = 1.5 / area * (1.0 - std::pow(2.0 * x / b - 1.0, 2));
    upright +=
        acting * h * t * shear * shear * 0.5 * (1.0 / wall.joints.tangential_stiffness + 1.0 / kMiddles);
  }
  const double young = wall.material.young_modulus;
  const double shear_modulus = young / (2.0 * (1.0 + wall.material.poisson_ratio));
  const double bricks =
      std::pow(height, 3) / (12.0 * young * inertia) + 1.2 * height / (shear_modulus * area);
  return {1.0 / (bricks + bed_bending + 1.2 * bed_shear + upright), 1.0 / (bed_bending + bed_shear)};
}

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

TEST_CASE("Before it cracks the Eindhoven wall is as stiff as theorems of least energy allow (closed forms)",
          "[mortar][path][many-solutions]") {
  BridgeDescription wall = read_bridge_file(test::example_bridge("eindhoven-wall")).description;
  wall.movements.back().x = 5e-5;
  wall.movements.back().steps = 1;
  const MovedStructure moved = follow_movements(make_model(wall), wall.movements);
  REQUIRE(moved.complete);
  const double stiffness = moved.points.back().force.x() / moved.points.back().moved.x();
  const StiffnessBounds bounds = stiffness_bounds(wall);
  CAPTURE(stiffness, bounds.least, bounds.greatest);
  CHECK(moved.points.back().at.dissipated < 1e-6);
  CHECK(stiffness > bounds.least);
  CHECK(stiffness < bounds.greatest);
}

TEST_CASE("A movement of a support that does not exist is refused with those that do", "[path]") {
  BridgeDescription wall = low_wall();
  wall.movements.front().support = "roof";
  CHECK_THROWS_WITH(follow_movements(make_model(wall), wall.movements),
                    "support in [[movements]]: 'roof' does not exist: expected one of foot 1, top");
}
