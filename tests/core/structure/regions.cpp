/// @file Materials of regions and soil on the rings. Oracles: the file's own numbers, areas under a line.

#include "core/structure/regions.h"

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "core/statics/quasi_static_solver.h"
#include "core/structure/fill.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

Model bridge_with(const std::string& text) {
  return make_model(parse_bridge_file(text, "r.toml").description);
}

}  // namespace

TEST_CASE("A region's blocks have its material, and a joint the weaker of its blocks' laws", "[regions]") {
  const Model bridge = bridge_with(
      "[[regions]]\nof = [\"ring\"]\nyoung_modulus_Pa = 1e10\nfriction_angle_deg = 30\n"
      "[[regions]]\nof = [\"0,10\", \"12,1\"]\ndensity_kg_m3 = 1000\nplane = \"strain\"\n");
  for (std::size_t b = 0; b < bridge.layout.size(); ++b) {
    const Block& block = bridge.layout.blocks[b];
    const Material& material = bridge.parameters.blocks[b];
    const bool light = block.label == "0,10" || block.label == "12,1";
    CHECK(material.young_modulus == (block.role == BlockRole::ring && !light ? 1e10 : 2.5e10));
    CHECK(material.density == (light ? 1000.0 : 2400.0));
    CHECK(material.plane == (light ? PlaneState::strain : PlaneState::stress));
  }
  int rough = 0;
  for (std::size_t j = 0; j < bridge.joints.size(); ++j) {
    const auto in_ring = [&](BlockId id) {
      return bridge.layout[id].role == BlockRole::ring && bridge.layout[id].label != "0,10";
    };
    const bool weak = in_ring(bridge.joints[j].first) || in_ring(bridge.joints[j].second);
    const JointMaterial plain;
    CHECK(bridge.parameters.joints[j].friction_angle ==
          Approx((weak ? 30.0 : 35.0) * std::numbers::pi / 180.0));
    CHECK(bridge.parameters.joints[j].normal_stiffness == plain.normal_stiffness);
    rough += !weak;
  }
  CHECK(rough > 400);
}

TEST_CASE("A bridge whose materials are no mirror image has no symmetry", "[regions]") {
  CHECK(bridge_with("[[regions]]\nof = [\"ring\"]\ndensity_kg_m3 = 2000\n").symmetry.has_value());
  CHECK_FALSE(bridge_with("[[regions]]\nof = [\"12,1\"]\ndensity_kg_m3 = 2000\n").symmetry.has_value());
  CHECK_FALSE(bridge_with("[[regions]]\nof = [\"12,1\"]\nfriction_angle_deg = 20\n").symmetry.has_value());
  CHECK_FALSE(
      bridge_with("[fill]\nunit_weight_N_m3 = 18000\nsurface_m = [[0, 6], [20, 7]]\n").symmetry.has_value());
}

TEST_CASE("A bridge with a dry joint in mortar is its own mirror image only with that joint's image",
          "[regions][mortar]") {
  const std::string mortar =
      "[[mortar]]\ntensile_strength_Pa = 0.05e6\nopening_energy_J_m2 = 18\ncohesion_Pa = 0.1e6\n"
      "slip_energy_J_m2 = 125\n";
  const std::string left = "[[mortar]]\nbetween = [\"12,1\", \"12,2\"]\ndry = true\n";
  const std::string right = "[[mortar]]\nbetween = [\"12,19\", \"12,20\"]\ndry = true\n";
  CHECK(bridge_with(mortar).symmetry.has_value());
  CHECK_FALSE(bridge_with(mortar + left).symmetry.has_value());
  CHECK(bridge_with(mortar + left + right).symmetry.has_value());
}

TEST_CASE("A region of nothing is refused", "[regions]") {
  CHECK_THROWS_WITH(bridge_with("[[regions]]\nof = [\"13,1\"]\n"), Contains("'13,1'") && Contains("role"));
  CHECK_THROWS_WITH(bridge_with("[[regions]]\ndensity_kg_m3 = 1\n"), Contains("r.toml:1:") && Contains("of"));
  CHECK_THROWS_WITH(bridge_with("[fill]\nunit_weight_N_m3 = 18000\n"), Contains("level_m or surface_m"));
  CHECK_THROWS_WITH(bridge_with("[fill]\nlevel_m = 7\n"), Contains("unit_weight_N_m3"));
}

TEST_CASE("Soil has the weight of the area between its surface and the extrados (closed form)", "[regions]") {
  // Semicircle of 4 m outer radius on 17 chords, alone: soil from the chords up to y = 6 between x = 6
  // and 14.
  const Model ring = bridge_with("[wall]\ncourses = 0\n[fill]\nunit_weight_N_m3 = 18000\nlevel_m = 6\n");
  const double chords = 0.5 * 17 * 16.0 * std::sin(std::numbers::pi / 17);
  const double below = 1.05 * 8.0 + chords;  // under the extrados
  CHECK(9.81 * ring.parameters.laid_mass.sum() == Approx(18000.0 * (6.0 * 8.0 - below)).epsilon(1e-9));
  CHECK(ring.symmetry.has_value());
  // A slope: its mean height counts.
  const Model wall = bridge_with("[fill]\nunit_weight_N_m3 = 18000\nsurface_m = [[0, 6], [5, 7], [20, 7]]\n");
  CHECK(9.81 * wall.parameters.laid_mass.sum() == Approx(18000.0 * (2.5 + 15.0)).epsilon(1e-9));
  // Below the top nothing lies.
  CHECK(bridge_with("[fill]\nunit_weight_N_m3 = 18000\nlevel_m = 5\n").parameters.laid_mass.sum() == 0.0);
}

TEST_CASE("A column under soil settles as under a heavier top block (closed form)", "[regions]") {
  const std::string column =
      "spans = []\n[wall]\nlength_m = 1\ncourses = 4\nbond = \"stack\"\n[supports]\nsides = "
      "\"free\"\n[material]\nyoung_modulus_Pa = 1e14\n";
  const Model plain = bridge_with(column);
  const Model loaded = bridge_with(column + "[fill]\nunit_weight_N_m3 = 20000\nlevel_m = 3\n");
  const auto top = [](const Model& model) {
    QuasiStaticSolver solver(model);
    const Solution solution = solver.solve(Scene{});
    REQUIRE(solution.outcome == Outcome::standing);
    return readings_at(model.control_points, solution.displacement)[0];
  };
  // 20 kN on each of three joints of 1e9 Pa/m and 1 m2.
  CHECK(top(loaded) - top(plain) == Approx(-3.0 * 20000.0 / 1e9).epsilon(1e-3));
}
