#include "tools/validation/history.h"

#include <catch2/catch.hpp>

#include "tests/support/bridges.h"
#include "tools/validation/load_runs.h"

using namespace voussoir;
using namespace voussoir::validation;

namespace {

Eigen::VectorXd settlements(const Model& bridge, const Solution& solution) {
  return readings_at(bridge.control_points, solution.displacement);
}

}  // namespace

TEST_CASE("A history of one stage is the scene solved alone, to the last bit", "[history]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSolver solver(bridge);
  const Scene scene = parse_scene("4,2", bridge.layout);
  const Solution alone = solver.solve(scene);
  const auto states = solve_history(solver, built(scene));
  REQUIRE(states.size() == 1);
  CHECK(without_nan(states[0].displacement) == without_nan(alone.displacement));
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

TEST_CASE("Displacements under loads are reciprocal where nothing slips (Maxwell)", "[history]") {
  const Model wall = rough_wall();
  const Stage pressed{.load = side_pressure(wall, 4.0, 2e4)};
  std::vector<int> components;  // of corners all over the wall, both ways
  for (int node = 3; node < wall.mesh.node_count(); node += 11)
    for (const int axis : {0, 1}) components.push_back(2 * node + axis);
  CHECK(reciprocity_error(wall, pressed, components, 100.0) < 1e-8);
}

TEST_CASE("A load that is added and taken away without slip leaves no trace (elasticity)", "[history]") {
  const Model wall = rough_wall();
  const Stage pressed{.load = side_pressure(wall, 4.0, 2e4)};
  const Field load = point_load(wall, NodeId{wall.mesh.node_count() - 2}, 1e3);
  for (const int steps : {1, 4}) {
    const LoadTrace trace = load_trace(wall, pressed, load, steps);
    CHECK(trace.under_load > 1e-6);
    CHECK(trace.left < 1e-5 * trace.under_load);  // Newton stops at 1e-8 of the pressure's 5 kN a node
  }
}

TEST_CASE("Where joints slip a load that has gone leaves a trace (reference bridge, 10 t on the crown)",
          "[history]") {
  // Oracle: the same in eight implicit steps each way; as with losses one step may be off by 5 %.
  const Model bridge = test::reference_bridge();
  const Field load = point_load(bridge, bridge.control_points[19].node, 1e5);
  const LoadTrace once = load_trace(bridge, {}, load);
  const LoadTrace often = load_trace(bridge, {}, load, 8);
  CHECK(once.left > 0.05 * once.under_load);
  CHECK(once.left == Approx(often.left).epsilon(0.05));
  CHECK(once.under_load == Approx(often.under_load).epsilon(0.05));
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
      solve_history(solver, followed_by(lost(arch_block), "load", point_load(bridge, NodeId{0}, 1.0)));
  REQUIRE(states.size() == 2);
  CHECK(states[1].outcome != Outcome::standing);
}
