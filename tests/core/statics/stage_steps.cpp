/// @file Later stages followed step by step, with their jumps. Oracles: closed forms, motion.

#include "core/statics/stage_steps.h"

#include <catch2/catch.hpp>

#include "core/solve/state_plan.h"
#include "core/statics/elements.h"
#include "core/statics/equilibrium.h"
#include "core/structure/loads.h"
#include "tests/support/bridges.h"
#include "tools/validation/release.h"

namespace voussoir {
namespace {

/// The small bridge with such joints.
Model bridge_with(double stiffness_ratio, double friction_angle) {
  BridgeDescription description = test::small_description();
  description.joints.normal_stiffness = 1e9;
  description.joints.tangential_stiffness = stiffness_ratio * 1e9;
  description.joints.friction_angle = friction_angle;
  return make_model(description);
}

struct Loss {
  Solution intact;
  Solution lost;
};

Loss lose(const Model& bridge, const Scene& scene, bool may_jump = true) {
  QuasiStaticSolver solver(bridge);
  Loss loss{solver.solve(Scene{}), {}};
  REQUIRE(stands(loss.intact));
  loss.lost = solver.solve(StageTask{.stage = {.scene = scene},
                                     .start = &loss.intact.displacement,
                                     .before = &loss.intact,
                                     .steps = kStepsOfLoss,
                                     .may_jump = may_jump});
  return loss;
}

}  // namespace

TEST_CASE("Where a loss has no equilibrium near, the bridge jumps to where motion comes to rest (motion)",
          "[history]") {
  const Model bridge = bridge_with(1.0, 0.6);
  const Scene scene = parse_scene("4,2", bridge.layout);
  const Solution stuck = lose(bridge, scene, false).lost;
  CHECK(stuck.outcome == Outcome::unresolved);
  CHECK(stuck.residual > QuasiStaticSettings{}.step_tolerance);

  const Loss loss = lose(bridge, scene);
  REQUIRE(stands(loss.lost));
  REQUIRE(loss.lost.slipped.cols() == static_cast<Eigen::Index>(bridge.joints.size()));
  const validation::LoadedBridge loaded(bridge);
  const DynamicSolution motion = loaded.without(scene);
  REQUIRE(stands(motion.solution));
  const Field jumped = without_nan(loss.lost.displacement - loss.intact.displacement);
  const Field moved = without_nan(motion.solution.displacement - loaded.intact().solution.displacement);
  // Motion and implicit steps differ by 1 % of the signal at most where nothing jumps (docs/numerics.md).
  CHECK((jumped - moved).cwiseAbs().maxCoeff() < 0.02 * moved.cwiseAbs().maxCoeff());
}

TEST_CASE("What slides away in a jump has collapsed, and is named (motion)", "[history]") {
  const Model bridge = bridge_with(0.03, 0.45);
  const Scene scene = parse_scene("4,1", bridge.layout);
  const Solution lost = lose(bridge, scene).lost;
  const DynamicSolution motion = validation::LoadedBridge(bridge).without(scene);
  REQUIRE(motion.solution.outcome == Outcome::collapsed);
  CHECK(lost.outcome == Outcome::collapsed);
  CHECK(lost.moving == motion.solution.moving);
  CHECK(lost.memory.empty());
  CHECK(lost.slipped.size() == 0);
}

TEST_CASE("Where friction hardly carries a load, a search goes on from where it got, or jumps (equilibrium)",
          "[history]") {
  const Model bridge = test::reference_bridge();
  const Scene scene = parse_scene("5,7+11,10", bridge.layout);
  QuasiStaticSettings settings;
  settings.follow_falls = false;
  QuasiStaticSolver solver(bridge, settings);
  const Solution before = solver.solve(StageTask{.stage = {.scene = scene}, .patient_phase = true});
  REQUIRE(stands(before));
  const LoadDescription crown{
      .name = "crown", .points = {{10.0, 2.5e4}}, .lines = {}, .axles = {}, .places = {}, .width = {}};
  const Stage loaded{.scene = scene, .load = load_stages(crown, bridge, 1.0).front().force};
  const StageTask task{.stage = loaded, .start = &before.displacement, .before = &before};
  const Solution found = solver.solve(task);
  REQUIRE(stands(found));
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  const StageEquations equations(system, coefficients, loaded, before.memory);
  const Field unbalanced = unbalanced_forces(equations, without_nan(found.displacement));
  CHECK(unbalanced.cwiseAbs().maxCoeff() < 1e-7 * equations.largest_load);
  settings.descends_near = false;
  StageTask without_jumps = task;
  without_jumps.may_jump = false;
  CHECK_FALSE(stands(QuasiStaticSolver(bridge, settings).solve(without_jumps)));
  const Solution jumped = QuasiStaticSolver(bridge, settings).solve(task);
  REQUIRE(stands(jumped));
  REQUIRE(jumped.slipped.cols() == static_cast<Eigen::Index>(bridge.joints.size()));
  const StageEquations slid(system, coefficients, loaded, memory_of_slip(jumped.slipped));
  const Field left = unbalanced_forces(slid, without_nan(jumped.displacement));
  CHECK(left.cwiseAbs().maxCoeff() < 1e-7 * slid.largest_load);
}

TEST_CASE("A block that only drag holds sinks by its reach (closed form)", "[history]") {
  const Model bridge = test::small_bridge();
  Scene scene;
  for (int block = 0; block + 1 < bridge.block_count(); ++block) scene.removed.push_back(BlockId{block});
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  StageEquations equations(system, coefficients, {.scene = scene});
  const Field place = Field::Zero(2, bridge.mesh.node_count());
  const double reach = 0.003;
  equations.drag = Drag{reach, place};
  Field sunk = place;
  const IndexRange nodes = bridge.mesh.block_nodes.back();
  sunk.middleCols(nodes.begin, nodes.size()).row(1).setConstant(-reach);
  CHECK(unbalanced_forces(equations, place).cwiseAbs().maxCoeff() > 0.1 * equations.largest_load);
  CHECK(unbalanced_forces(equations, sunk).cwiseAbs().maxCoeff() < 1e-9 * equations.largest_load);
}

TEST_CASE("The tangent has the drag's stiffness, weight over reach, on its diagonal (closed form)",
          "[history]") {
  const Model bridge = test::small_bridge();
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  StageEquations equations(system, coefficients, {});
  const Field place = Field::Zero(2, bridge.mesh.node_count());
  Eigen::SparseMatrix<double> free = system.pattern, dragged = system.pattern;
  assemble(equations, place, 0.0, {free.valuePtr()});
  equations.drag = Drag{1e-5, place};
  assemble(equations, place, 0.0, {dragged.valuePtr()});
  const Eigen::MatrixXd added = dragged - free;
  for (int unknown = 0; unknown < system.unknown_count(); ++unknown) {
    const double weight = coefficients.weight[system.component[static_cast<std::size_t>(unknown)] / 2];
    CHECK(added(unknown, unknown) == Approx(weight / 1e-5).epsilon(1e-6));
  }
  CHECK(added.cwiseAbs().sum() == Approx(added.trace()));
}

}  // namespace voussoir
