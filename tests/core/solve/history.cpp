#include "core/solve/history.h"

#include <catch2/catch.hpp>

#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

Eigen::VectorXd settlements(const Model& bridge, const Solution& solution) {
  return vertical_displacements(solution.displacement, bridge.control_points);
}

/// A force on the node of a control point, downwards [N].
Field point_load(const Model& bridge, std::size_t point, double force) {
  Field load = Field::Zero(2, bridge.mesh.node_count());
  load(1, value(bridge.control_points[point].node)) = -force;
  return load;
}

}  // namespace

TEST_CASE("A history of one stage is the scene solved alone, to the last bit", "[history]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSolver solver(bridge);
  const Scene scene = parse_scene("4,2", bridge.layout);
  const Solution alone = solver.solve(scene);
  const auto states = solve_history(solver, built(scene));
  REQUIRE(states.size() == 1);
  CHECK(test::without_nan(states[0].displacement) == test::without_nan(alone.displacement));
  CHECK(states[0].memory == alone.memory);
}

TEST_CASE("A stage that changes nothing leaves the bridge where it is (the memory keeps the shear)",
          "[history]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSolver solver(bridge);
  const auto states = solve_history(solver, lost(Scene{}));
  REQUIRE(states.size() == 2);
  CHECK((states[1].displacement - states[0].displacement).cwiseAbs().maxCoeff() <
        1e-9 * states[0].displacement.cwiseAbs().maxCoeff());
}

TEST_CASE("A load that is added and taken away without slip leaves no trace (elasticity)", "[history]") {
  BridgeDescription description = test::small_description();
  description.joints.friction_angle = 1.5;  // nothing slips
  const Model bridge = make_model(description);
  QuasiStaticSolver solver(bridge);
  const Field load = point_load(bridge, bridge.control_points.size() / 4, 1e3);
  const auto states =
      solve_history(solver, followed_by(followed_by(built({}), "loaded", load), "unloaded", -load));
  REQUIRE(states.size() == 3);
  const double sag = settlements(bridge, states[0]).cwiseAbs().maxCoeff();
  CHECK((settlements(bridge, states[1]) - settlements(bridge, states[0])).cwiseAbs().maxCoeff() > 1e-3 * sag);
  CHECK((settlements(bridge, states[2]) - settlements(bridge, states[0])).cwiseAbs().maxCoeff() < 1e-7 * sag);
}

TEST_CASE(
    "Where joints slip the order of events counts: lost is not built (published: 10 to 40 % of the signal)",
    "[history]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSolver solver(bridge);
  const Scene scene = parse_scene("4,10", bridge.layout);
  const auto intact = solve_history(solver, built({}));
  const auto never_built = solve_history(solver, built(scene));
  const auto taken_out = solve_history(solver, lost(scene));
  REQUIRE(taken_out.size() == 2);
  REQUIRE(taken_out[1].outcome == Outcome::standing);
  const Eigen::VectorXd start = settlements(bridge, intact[0]);
  const Eigen::VectorXd signal = settlements(bridge, never_built[0]) - start;
  const Eigen::VectorXd lost_signal = settlements(bridge, taken_out[1]) - start;
  const double difference = (lost_signal - signal).lpNorm<1>() / signal.lpNorm<1>();
  CHECK(difference > 1e-3);
  CHECK(difference < 0.5);
}

TEST_CASE("After a stage that does not stand a history has no more stages", "[history]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSolver solver(bridge);
  Scene arch_block;
  for (std::size_t b = 0; b < bridge.layout.size(); ++b)
    if (bridge.layout.blocks[b].kind == BlockKind::voussoir)
      arch_block.removed = {BlockId{static_cast<int>(b)}};
  const auto states =
      solve_history(solver, followed_by(lost(arch_block), "load", point_load(bridge, 0, 1.0)));
  REQUIRE(states.size() == 2);
  CHECK(states[1].outcome != Outcome::standing);
}
