/// @file Stages with a temperature and with supports that move. Oracles: closed forms of free and held bars,
/// rigid motion.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/statics/equilibrium.h"
#include "core/statics/quasi_static_solver.h"
#include "core/structure/rigid_movement.h"
#include "core/structure/uncertain_parameters.h"
#include "tests/support/bridges.h"
#include "tools/validation/assemblies.h"

using namespace voussoir;

namespace {

constexpr double kBeamLength = 4.0, kBeamHeight = 0.5;

/// A bar on a smooth base and against a smooth wall at its left end; at its right one, too, or free there.
Model bar(PlaneState plane, bool held) {
  BridgeDescription description;
  description.supports = {.base = SupportKind::roller, .sides = SupportKind::roller};
  description.material.plane = plane;
  description.wall.length = held ? kBeamLength : 2.0 * kBeamLength;
  description.mesh.refinement = 2;
  return validation::assemble_blocks(description,
                                     {validation::rectangle(Point(0.0, 0.0), kBeamLength, kBeamHeight)});
}

/// Two blocks of half a square metre, one upon the other, free to expand.
Model column_of_two() {
  BridgeDescription description;
  description.supports = {.base = SupportKind::roller, .sides = SupportKind::roller};
  description.wall.length = 10.0;
  return validation::assemble_blocks(description, {validation::rectangle(Point(0.0, 0.0), 1.0, 0.5),
                                                   validation::rectangle(Point(0.0, 0.5), 1.0, 0.5)});
}

/// Displacement of the corner that lies furthest from the supports.
Point corner_of_heated(const Model& bridge, double temperature) {
  QuasiStaticSolver solver(bridge);
  const Solution solution =
      solver.solve(StageTask{.stage = {.gravity_share = 0.0, .temperature = temperature}});
  REQUIRE(solution.outcome == Outcome::standing);
  for (int node = 0; node < bridge.mesh.node_count(); ++node)
    if (bridge.mesh.nodes.col(node) == Point(kBeamLength, kBeamHeight))
      return solution.displacement.col(node);
  throw std::runtime_error("no such corner");
}

/// Elongation per length at this Green strain.
double elongation(double strain) {
  return std::sqrt(1.0 + 2.0 * strain) - 1.0;
}

/// All supports' nodes by the same vector.
Field moved_together(const Model& bridge, const Point& movement) {
  Field field = Field::Zero(2, bridge.mesh.node_count());
  for (std::size_t s = 0; s < bridge.supports.size(); ++s) {
    const Field one = rigid_movement(bridge, s, movement, 0.0);
    field = (one.array() != 0.0).select(one, field);
  }
  return field;
}

}  // namespace

TEST_CASE("A bar that is free to expand does so, and out of plane held the more (closed form)", "[stage]") {
  const double strain = 8e-6 * 30.0;
  const Point stress = corner_of_heated(bar(PlaneState::stress, false), 30.0);
  CHECK(stress.x() == Approx(kBeamLength * elongation(strain)).epsilon(1e-7));
  CHECK(stress.y() == Approx(kBeamHeight * elongation(strain)).epsilon(1e-7));
  const Point plane_strain = corner_of_heated(bar(PlaneState::strain, false), 30.0);
  CHECK(plane_strain.x() == Approx(kBeamLength * elongation(1.2 * strain)).epsilon(1e-7));
  CHECK(plane_strain.y() == Approx(kBeamHeight * elongation(1.2 * strain)).epsilon(1e-7));
}

TEST_CASE("A bar that is held at both ends grows upwards only, by (1 + nu) times the strain (closed form)",
          "[stage]") {
  const Point corner = corner_of_heated(bar(PlaneState::stress, true), 30.0);
  CHECK(corner.x() == 0.0);
  CHECK(corner.y() == Approx(kBeamHeight * elongation(1.2 * 8e-6 * 30.0)).epsilon(1e-7));
}

TEST_CASE("A column of two blocks grows by its own expansion and not by its joint's (closed form)",
          "[stage]") {
  const Model column = column_of_two();
  QuasiStaticSolver solver(column);
  const Solution cold = solver.solve(Scene{});
  const Solution warm = solver.solve(StageTask{.stage = {.temperature = 20.0}});
  REQUIRE(cold.outcome == Outcome::standing);
  REQUIRE(warm.outcome == Outcome::standing);
  const Field growth = warm.displacement - cold.displacement;
  const double strain = 8e-6 * 20.0;
  for (int node = 0; node < column.mesh.node_count(); ++node)  // the weight's own strains are 5e-7
    CHECK((growth.col(node) - strain * column.mesh.nodes.col(node)).norm() <
          1e-6 * 20.0 * 8e-6 + strain * strain);
}

TEST_CASE("A stone that is warmer than the one that it stands on grows by itself (closed form)", "[stage]") {
  const Model column = column_of_two();
  QuasiStaticSolver solver(column);
  Eigen::ArrayXd upper = Eigen::ArrayXd::Zero(2);
  upper[1] = 20.0;
  const auto growth = [&](const Stage& stage) {
    const Solution solution = solver.solve(StageTask{.stage = stage});
    REQUIRE(stands(solution));
    double highest = 0.0;
    for (int node = 0; node < column.mesh.node_count(); ++node)
      if (column.mesh.nodes(1, node) == 1.0) highest = solution.displacement(1, node);
    return highest;
  };
  const double weight = growth({}), strain = 8e-6 * 20.0;
  // The joint between them holds the warm stone's base back a little.
  CHECK(growth({.uneven_temperature = upper}) - weight == Approx(0.5 * strain).epsilon(0.1));
  CHECK(growth({.temperature = -20.0, .uneven_temperature = upper}) - weight ==
        Approx(-0.5 * strain).epsilon(0.1));
  const Eigen::ArrayXd both = Eigen::ArrayXd::Constant(2, 20.0);
  CHECK(growth({.uneven_temperature = both}) == Approx(growth({.temperature = 20.0})).epsilon(1e-9));
}

TEST_CASE("Supports that all move together carry the bridge with them and change no force (rigid motion)",
          "[stage]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSolver solver(bridge);
  const Solution still = solver.solve(Scene{});
  const Point movement(0.7e-3, -1.9e-3);
  const Solution moved =
      solver.solve(StageTask{.stage = {.support_movement = moved_together(bridge, movement)}});
  REQUIRE(moved.outcome == Outcome::standing);
  const Field carried = (moved.displacement - still.displacement).colwise() - movement;
  CHECK(carried.cwiseAbs().maxCoeff() < 1e-9);  // what the solver's tolerance leaves
  double largest = 0.0;
  for (std::size_t j = 0; j < moved.memory.size(); ++j)
    largest = std::max(largest, std::abs(moved.memory[j].slip_0 - still.memory[j].slip_0));
  CHECK(largest < 1e-9);
}

TEST_CASE(
    "One foot that settles takes down what stands on it, and a stage without movement has no trace of it",
    "[stage]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSolver solver(bridge);
  const Solution still = solver.solve(Scene{});
  const auto left_foot = static_cast<std::size_t>(
      std::ranges::find(bridge.supports, "foot 1", &Support::name) - bridge.supports.begin());
  const Stage settled{.support_movement = rigid_movement(bridge, left_foot, {0.0, -1e-3}, 0.0)};
  const Solution moved = solver.solve(StageTask{.stage = settled, .start = &still.displacement});
  REQUIRE(moved.outcome == Outcome::standing);
  for (const NodeId node : bridge.supports[left_foot].nodes)
    CHECK(moved.displacement(1, value(node)) == -1e-3);
  const EquilibriumSystem& system = solver.system();
  const Coefficients coefficients(system, bridge.parameters);
  CHECK(unbalanced_force(StageEquations(system, coefficients, settled), moved.displacement) < 1e-7);
  const Eigen::VectorXd change = readings_at(bridge.control_points, moved.displacement - still.displacement);
  CHECK(change.head(1)[0] < -0.9e-3);    // T1 stands on the foot that settled
  CHECK(std::abs(change[39]) < 0.1e-3);  // T40 on the other one
  const Solution again = solver.solve(StageTask{.stage = {}});
  CHECK(again.displacement == still.displacement);
}

TEST_CASE(
    "Joints that have gone soft or stiff in a stage are those of a bridge with such joints (that bridge)",
    "[stage]") {
  const BridgeDescription description = test::small_description();
  const Model bridge = make_model(description);
  BridgeDescription soft_description = description;
  soft_description.joints.normal_stiffness *= 0.8;
  soft_description.joints.tangential_stiffness *= 0.8;
  const Model soft = make_model(soft_description);
  QuasiStaticSolver solver(bridge), soft_solver(soft);
  const auto joints = static_cast<Eigen::Index>(bridge.joints.size());
  const Stage softer{.joint_stiffness = Eigen::ArrayXd::Constant(joints, 0.8)};
  const StageTask in_epoch{.stage = softer};
  const Solution expected = soft_solver.solve(StageTask{});
  REQUIRE(stands(expected));
  for (const Parameters* own : {static_cast<const Parameters*>(nullptr), &bridge.parameters}) {
    StageTask task = in_epoch;
    task.parameters = own;
    const Solution found = solver.solve(task);
    REQUIRE(stands(found));
    CHECK((found.displacement - expected.displacement).cwiseAbs().maxCoeff() < 1e-10);
  }
  // A stage that comes later bears on the softer joints, too, and the next one on the bridge's own again.
  const Solution built = solver.solve(StageTask{});
  const Solution later =
      solver.solve(StageTask{.stage = softer, .start = &built.displacement, .before = &built});
  REQUIRE(stands(later));
  const double sank = readings_at(bridge.control_points, later.displacement - built.displacement).sum();
  const double expected_sank =
      readings_at(bridge.control_points, expected.displacement - built.displacement).sum();
  CHECK(sank == Approx(expected_sank).epsilon(0.05));
  CHECK(solver.solve(StageTask{}).displacement == built.displacement);
}
