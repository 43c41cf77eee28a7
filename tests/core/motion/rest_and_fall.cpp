/// @file What a motion that ends says of statics.

#include <catch2/catch.hpp>

#include "core/motion/dynamic_solver.h"
#include "core/statics/equilibrium.h"
#include "tests/support/bridges.h"

namespace voussoir {

TEST_CASE("Where blocks rest that have slid, field and slip are in balance (the equations of statics)") {
  const Model bridge = make_model(test::sliding_description());
  for (const char* const name : {"5,3", "5,5"}) {
    INFO(name);
    const Scene scene = parse_scene(name, bridge.layout);
    const Solution rest = DynamicSolver(bridge)
                              .solve(std::span(&scene, 1), far_fall_rules(patient_rules(DecisionRules{})))
                              .front()
                              .solution;
    REQUIRE(rest.slipped.cols() == static_cast<Eigen::Index>(bridge.joints.size()));
    const double without_slip = unbalanced_force(bridge, scene, rest.displacement);
    CHECK(without_slip > 0.05);
    CHECK(unbalanced_force(bridge, scene, rest.displacement, rest.slipped) < 0.1 * without_slip);
  }
}

TEST_CASE("A block that drops by one course has fallen, though soft joints sag far (plain explicit motion)") {
  const Model bridge = make_model(test::soft_description());
  DynamicSolver solver(bridge);
  const DecisionRules rules = far_fall_rules(patient_rules(DecisionRules{}));
  REQUIRE(rules.moving_sags * solver.sag() > mean_block_size(bridge));
  const Scene scene = parse_scene("0,5", bridge.layout);
  const DynamicSolution fallen = solver.solve(std::span(&scene, 1), rules).front();
  CHECK_FALSE(fallen.solution.moving.empty());
  DynamicSettings settings;
  settings.integrator = Integrator::central_differences;
  const DynamicSolution plain = DynamicSolver(bridge, settings).solve(std::span(&scene, 1), rules).front();
  CHECK(plain.solution.outcome == Outcome::collapsed);
  CHECK(fallen.solution.outcome == plain.solution.outcome);
}

}  // namespace voussoir
