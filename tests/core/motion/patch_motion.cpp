/// @file Motions in patches. Oracles: motions and equilibria of the whole bridge.

#include <catch2/catch.hpp>

#include "core/motion/motion_run.h"
#include "core/statics/quasi_static_solver.h"
#include "tests/support/bridges.h"

using namespace voussoir;

TEST_CASE("In a patch with everything in it scenes move as in the bridge (its motions)", "[motion][patch]") {
  const Model bridge = test::small_bridge();
  DynamicSolver solver(bridge);
  const Field nowhere = Field::Zero(2, bridge.mesh.node_count());
  int falls = 0;
  for (const char* name : {"0,4", "0,6", "4,2", "5,3"}) {
    INFO(name);
    const Scene scene = parse_scene(name, bridge.layout);
    const Solution expected = solver.solve(scene).solution;
    const Patch patch = solver.patch_around(scene, bridge.block_count());
    const Solution found = solver.solve_in(patch, scene, nowhere, DecisionRules{});
    CHECK(found.outcome == expected.outcome);
    CHECK(found.extent == expected.extent);
    CHECK(found.moving == expected.moving);
    CHECK(found.iterations == expected.iterations);
    CHECK(found.residual == Approx(expected.residual));
    CHECK(found.displacement.array().isNaN().all());
    falls += found.outcome == Outcome::collapsed ? 1 : 0;
  }
  CHECK(falls > 0);
  CHECK(falls < 4);
}

TEST_CASE("Blocks of a patch come to rest where they do in the bridge (Newton's equilibrium)",
          "[motion][patch]") {
  const Model bridge = test::reference_bridge();
  const EquilibriumSystem system(bridge);
  const FollowedBridge whole(bridge, system, DynamicSettings{});
  const Field intact = QuasiStaticSolver(bridge).solve(Scene{}).displacement;
  const Patch patch = patch_around(parse_scene("10,4", bridge.layout), 2, bridge);
  const Field expected = patch.field_of(intact);
  const FollowedBridge near(whole, patch, expected);
  const DecisionRules rules = patient_rules(DecisionRules{});
  const std::vector<Scene> scenes(1);
  const std::vector<MotionStart> starts(1, MotionStart::at_rest);
  const DynamicSolution found = MotionRun<double>(near, rules, scenes, starts).run().front();
  REQUIRE(stands(found.solution));
  // motion lets joints slide a little on the way: 0.3 % is allowed for whole bridges (docs/numerics.md)
  CHECK((found.solution.displacement - expected).cwiseAbs().maxCoeff() <
        3e-3 * expected.cwiseAbs().maxCoeff());
}
