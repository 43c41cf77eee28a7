/// @file Joints with mortar in motion. Oracles: strength against weight, Newton's method with the same law,
/// the other lanes, the history `lost`.

#include "core/motion/bonds.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/motion/dynamic_solver.h"
#include "tests/support/bridges.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/hard_case_runs.h"
#include "tools/validation/history.h"
#include "tools/validation/release.h"

using namespace voussoir;

namespace {

constexpr double kSize = 0.5;                       ///< [m] height of a block
constexpr double kHanging = 2400.0 * 9.81 * kSize;  ///< [Pa] what hangs on the joint above it

/// A block of 1 m x 0.5 m that hangs below one which a support holds.
Model hanging_block(double tensile_strength) {
  BridgeDescription description;
  description.supports = {.base = SupportKind::free, .sides = SupportKind::free};
  description.wall.length = 100.0;
  description.joints.mortar = {.tensile_strength = tensile_strength,
                               .opening_energy = 1e-4 * tensile_strength,
                               .cohesion = 2.0 * tensile_strength,
                               .slip_energy = 1e-3 * tensile_strength,
                               .friction_angle = std::atan(0.75)};
  Model model =
      validation::assemble_blocks(description, {validation::rectangle({50.0, 10.0}, 1.0, kSize),
                                                validation::rectangle({50.0, 10.0 + kSize}, 1.0, kSize)});
  Support ceiling{.name = "ceiling", .nodes = {}, .holds_x = true, .holds_y = true};
  for (int node = model.mesh.block_nodes[1].begin; node < model.mesh.block_nodes[1].end; ++node)
    ceiling.nodes.push_back(NodeId{node});
  model.supports.push_back(ceiling);
  return model;
}

Model bridge_with_mortar() {
  return make_model(test::small_description_with_mortar());
}

std::vector<Scene> some_scenes(const Model& bridge) {
  std::vector<Scene> scenes;
  for (const char* text : {"intact", "4,2", "0,4", "2,2", "5,4"})
    scenes.push_back(parse_scene(text, bridge.layout));
  return scenes;
}

}  // namespace

TEST_CASE("A block hangs on mortar as strong as its weight, and falls from weaker (statics)", "[mortar]") {
  const Model held = hanging_block(1.1 * kHanging);
  const DynamicSolution hangs = DynamicSolver(held).solve(Scene{});
  CHECK(hangs.solution.outcome == Outcome::standing);
  const double opening = kHanging / held.parameters.joints.front().normal_stiffness;  // elastic still
  const int lowest = held.mesh.block_nodes[0].begin;
  CHECK(-hangs.solution.displacement(1, lowest) == Approx(opening).epsilon(0.1));

  const DynamicSolution falls = DynamicSolver(hanging_block(0.9 * kHanging)).solve(Scene{});
  CHECK(falls.solution.outcome == Outcome::collapsed);
  CHECK(falls.solution.moving == std::vector<BlockId>{BlockId{0}});
}

TEST_CASE("A bond is gone once all of it is worn, and holds while a part of it does (the law itself)",
          "[mortar]") {
  const Model model = hanging_block(1e5);
  const std::vector<BondedJoint> joints = bonded_joints(model, ContactSearch(model));
  REQUIRE(joints.size() == 1);
  const auto pulled = [&](double at_left, double at_right) {
    MortarBond bond;
    Vector8d displacement = Vector8d::Zero();  // of the two edges' ends, in the joint's order
    for (int corner = 0; corner < 4; ++corner) {
      const int node = joints.front().nodes[static_cast<std::size_t>(corner)];
      if (node >= model.mesh.block_nodes[0].end) continue;
      displacement[2 * corner + 1] = model.mesh.nodes(0, node) < 50.5 ? -at_left : -at_right;
    }
    const Vector8d force = follow_bond(joints.front(), displacement, bond);
    CHECK(force.head<4>().sum() + force.tail<4>().sum() == Approx(0.0).margin(1e-6));
    return bond.holds;
  };
  CHECK(pulled(1e-6, 1e-6));
  CHECK(pulled(0.0, 0.01));
  CHECK_FALSE(pulled(0.01, 0.01));
}

TEST_CASE("What comes to rest with mortar is where Newton's method says, dry it is not (same law)",
          "[mortar]") {
  const Model bridge = bridge_with_mortar(), dry = test::small_bridge();
  DynamicSettings settings;
  settings.decision.standing_unbalance = 1e-6;
  DynamicSolver motion(bridge, settings);
  QuasiStaticSolver newton(bridge);
  int standing = 0;
  for (const Scene& scene : some_scenes(bridge)) {
    INFO(to_string(scene, bridge.layout));
    const Solution expected = newton.solve(scene);
    const DynamicSolution found = motion.solve(scene);
    CHECK(found.solution.outcome == expected.outcome);
    if (expected.outcome != Outcome::standing || found.solution.outcome != Outcome::standing) continue;
    ++standing;
    // Set beforehand: the steps of growing gravity wear a little where one implicit step does not.
    CHECK(validation::relative_difference(test::readings(bridge, found.solution.displacement),
                                          test::readings(bridge, expected.displacement)) < 0.01);
  }
  CHECK(standing >= 3);
  const Scene scene = parse_scene("0,4", bridge.layout);
  CHECK(DynamicSolver(dry).solve(scene).solution.outcome == Outcome::collapsed);
  CHECK(motion.solve(scene).solution.outcome == Outcome::standing);
}

TEST_CASE("Scenes with mortar have the same bits alone and side by side (the scalar solver)", "[mortar]") {
  const Model bridge = bridge_with_mortar();
  const std::vector<Scene> scenes = some_scenes(bridge);
  DynamicSolver solver(bridge);
  const std::vector<DynamicSolution> together = solver.solve(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const DynamicSolution alone = solver.solve(scenes[i]);
    CHECK(alone.solution.outcome == together[i].solution.outcome);
    CHECK(without_nan(alone.solution.displacement) == without_nan(together[i].solution.displacement));
  }
}

TEST_CASE(
    "Blocks let go slowly out of mortar change the bridge as the history lost does (independent solver)",
    "[mortar][many-solutions]") {
  const Model bridge = bridge_with_mortar();
  const validation::LoadedBridge loaded(bridge);
  REQUIRE(loaded.intact().solution.outcome == Outcome::standing);
  QuasiStaticSolver newton(bridge);
  for (const char* text : {"4,2", "2,2"}) {
    INFO(text);
    const Scene scene = parse_scene(text, bridge.layout);
    const std::vector<Solution> states = validation::solve_history(newton, validation::lost(scene));
    const DynamicSolution without = loaded.without(scene);
    REQUIRE(states.size() == 2);
    REQUIRE(states[1].outcome == Outcome::standing);
    REQUIRE(without.solution.outcome == Outcome::standing);
    const auto change = [&](const Field& after, const Field& before) -> Eigen::VectorXd {
      return test::readings(bridge, after) - test::readings(bridge, before);
    };
    CHECK(validation::relative_difference(
              change(without.solution.displacement, loaded.intact().solution.displacement),
              change(states[1].displacement, states[0].displacement)) < 0.02);
  }
}
