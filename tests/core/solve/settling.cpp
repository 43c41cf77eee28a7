/// @file Bridges that do not rest where Newton's method has found them.

#include "core/solve/settling.h"

#include <catch2/catch.hpp>

#include "core/motion/dynamic_solver.h"
#include "core/structure/uncertain_parameters.h"
#include "tests/support/bridges.h"
#include "tests/support/same_bits.h"
#include "tools/validation/random_bridge.h"

namespace voussoir {
namespace {

constexpr std::uint64_t kBridge = 190, kJoints = 15;  // 89 blocks, stack bond

/// The bridge with scattered joints that settles by 1.5 of its 2 mm.
Model settling_bridge() {
  const BridgeDescription description = random_bridge(kBridge);
  return sampled(make_model(description), description.uncertainty, kJoints);
}

/// What a bridge built in one step moves at most in a change of temperature [m].
double moved_by(QuasiStaticSolver& newton, const Solution& built, double warmer) {
  const StageTask stage{.stage = {.temperature = warmer}, .start = &built.displacement, .before = &built};
  const Solution found = newton.solve({&stage, 1}).front();
  REQUIRE(stands(found));
  return (found.displacement - built.displacement).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("A bridge that gives way at the least disturbance rests where it settles (motion)") {
  const Model bridge = settling_bridge();
  QuasiStaticSolver newton(bridge);
  const StageTask task{};
  const std::vector<Solution> found = newton.solve({&task, 1});
  REQUIRE(stands(found.front()));
  CHECK(moved_by(newton, found.front(), -0.1) > 1e-3);

  const Solution rests = settle({&task, 1}, found, [&](std::span<const StageTask> stages) {
                           return newton.solve(stages);
                         }).front();
  REQUIRE(stands(rests));
  REQUIRE(has_slipped(rests));
  CHECK(unbalanced_force(bridge, {}, rests.displacement, rests.slipped) < 1e-7);
  CHECK(unbalanced_force(bridge, {}, rests.displacement) > 1e-2);
  for (const double warmer : {-0.1, 0.1, -0.01, 0.01}) CHECK(moved_by(newton, rests, warmer) < 3e-5);

  DynamicSettings slow;
  slow.ramp = slow.moment = 2.0;
  slow.least_step = 0.0;  // joints as they are
  slow.decision = patient_rules(slow.decision);
  slow.decision.earliest_decision = 2.1;
  const std::vector<Scene> intact(1);
  const Field moved = DynamicSolver(bridge, slow).solve(intact).front().solution.displacement;
  CHECK((moved - rests.displacement).cwiseAbs().maxCoeff() < 2e-4);
  CHECK((moved - found.front().displacement).cwiseAbs().maxCoeff() > 1e-3);
}

TEST_CASE("A bridge that does not jump stays as it was found, and so do scenes (bits)") {
  const Model bridge = make_model(test::small_description());
  QuasiStaticSolver newton(bridge);
  const std::vector<StageTask> tasks = {{}, {.stage = {.scene = parse_scene("4,2", bridge.layout)}}};
  const std::vector<Solution> found = newton.solve(tasks);
  std::size_t disturbed = 0;
  const std::vector<Solution> rests = settle(tasks, found, [&](std::span<const StageTask> stages) {
    disturbed += stages.size();
    return newton.solve(stages);
  });
  CHECK(disturbed == 4);  // the intact bridge alone, cooler, warmer and back
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    CHECK(test::same_bits(rests[i].displacement, found[i].displacement));
    CHECK(rests[i].slipped.size() == 0);
  }
}

}  // namespace voussoir
