/// @file Settings that only find what falls. Oracle: motions with the settings as they are.

#include "core/solve/outcomes_only.h"

#include <catch2/catch.hpp>

#include "core/solve/combined_solver.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

const SolverSettings kPlain = SolverSettings::of(SolverKind::quasi_static);

Model stiff_bridge(double times) {
  BridgeDescription description = test::small_description();
  description.joints.normal_stiffness *= times;
  description.joints.tangential_stiffness *= times;
  return make_model(description);
}

}  // namespace

TEST_CASE("The reference bridge's motions follow its joints, and keep their times", "[combined]") {
  const Model& bridge = test::reference_bridge();
  CHECK_FALSE(softens_joints(kPlain.motion, bridge));
  const SolverSettings quick = for_outcomes(kPlain, bridge);
  CHECK(quick.motion.ramp == kPlain.motion.ramp);
  CHECK(quick.patient.latest_decision == kPlain.patient.latest_decision);
}

TEST_CASE("Of a bridge that swings n times as fast, times are an n-th (frequency of bonded joints)",
          "[combined]") {
  const Model bridge = stiff_bridge(10.0);
  const SolverSettings quick = for_outcomes(kPlain, bridge);
  const double share = quick.motion.ramp / kPlain.motion.ramp;
  CHECK(share < 1.0);
  const double reference = DynamicSolver(test::reference_bridge()).frequency();
  CHECK(share * DynamicSolver(bridge, quick.motion).frequency() == Approx(reference).epsilon(0.02));
  CHECK(quick.motion.moment / kPlain.motion.moment == Approx(share));
  CHECK(quick.motion.decision.latest_decision / kPlain.motion.decision.latest_decision == Approx(share));
  CHECK(quick.patient.freer_until / kPlain.patient.freer_until == Approx(share));
}

TEST_CASE("With mortar times stay as they are, however fast the bridge swings", "[combined]") {
  BridgeDescription description = test::small_description_with_mortar();
  description.joints.normal_stiffness *= 10.0;
  CHECK(for_outcomes(kPlain, make_model(description)).motion.ramp == kPlain.motion.ramp);
}

TEST_CASE("The same singles of a stiff bridge fall in the same way, in a fraction of the steps (as they are)",
          "[combined][many-solutions]") {
  const Model bridge = stiff_bridge(100.0);
  REQUIRE(softens_joints(kPlain.motion, bridge));
  const std::vector<Scene> scenes = all_scenes(bridge.layout.size(), 1);
  std::vector<StageTask> tasks;
  for (const Scene& scene : scenes) tasks.push_back({.stage = {.scene = scene}});
  const auto plain = CombinedSolver(bridge, acting_settings(kPlain, bridge)).solve(tasks);
  const auto quick =
      CombinedSolver(bridge, acting_settings(for_outcomes(kPlain, bridge), bridge)).solve(tasks);
  int falls = 0, steps = 0, quick_steps = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    INFO(to_string(scenes[i], bridge.layout));
    CHECK(quick[i].outcome == plain[i].outcome);
    CHECK(quick[i].extent == plain[i].extent);
    if (plain[i].outcome != Outcome::collapsed) continue;
    ++falls;
    steps += plain[i].iterations;
    quick_steps += quick[i].iterations;
  }
  CHECK(falls > 3);
  CHECK(3 * quick_steps < steps);
}
