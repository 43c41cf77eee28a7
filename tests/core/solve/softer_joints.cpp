/// @file Equilibria of stiff joints from softer ones. Oracles: equilibrium from the field alone, Newton's
/// method where it finds one by itself.

#include "core/solve/softer_joints.h"

#include <catch2/catch.hpp>

#include "core/solve/combined_solver.h"
#include "core/statics/equilibrium.h"
#include "tests/support/bridges.h"
#include "tools/validation/hard_case_runs.h"

using namespace voussoir;

TEST_CASE("Joints a thousand times as stiff as the reference's: softer ones lead to equilibria",
          "[combined]") {
  BridgeDescription description = reference_bridge_file().description;
  description.joints.normal_stiffness = 1e12;
  description.joints.tangential_stiffness = 1e11;
  const Model bridge = make_model(description);
  const SolverSettings settings = acting_settings(SolverSettings::of(SolverKind::quasi_static), bridge);
  REQUIRE(settings.softest_joints < 0.01);
  std::vector<StageTask> tasks;
  for (const char* text : {"10,4", "9,8", "12,1", "12,13", "0,15"})
    tasks.push_back({.stage = {.scene = parse_scene(text, bridge.layout)}});

  QuasiStaticSettings quick = settings.newton;
  quick.patient_first = false;
  QuasiStaticSolver newton(bridge, quick), approach(bridge, approaching(settings.newton));
  const std::vector<Solution> direct = newton.solve(tasks);
  const std::vector<Approach> found =
      approach_from_softer_joints(approach, bridge.parameters, settings.softest_joints, tasks);
  for (std::size_t i = 0; i + 1 < tasks.size(); ++i) {
    INFO(to_string(tasks[i].stage.scene, bridge.layout));
    REQUIRE(found[i].solution.outcome == Outcome::standing);
    CHECK(unbalanced_force(bridge, tasks[i].stage.scene, found[i].solution.displacement) < 1e-7);
  }
  REQUIRE(direct[0].outcome == Outcome::standing);
  CHECK(validation::relative_difference(
            vertical_displacements(found[0].solution.displacement, bridge.control_points),
            vertical_displacements(direct[0].displacement, bridge.control_points)) < 1e-7);
  CHECK(found.back().solution.outcome == Outcome::unresolved);  // falls
  CHECK(found.back().reached == 0.0);

  int more = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (!stands(direct[i]) && stands(found[i].solution)) ++more;
  CHECK(more >= 1);
}
