/// @file Falls near the missing blocks. Oracle: motions of the whole bridge.

#include "core/solve/near_falls.h"

#include <catch2/catch.hpp>

#include "core/solve/combined_solver.h"
#include "core/solve/outcomes_only.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

SolverSettings outcomes(const Model& bridge, bool nearby) {
  SolverSettings settings = SolverSettings::of(SolverKind::quasi_static);
  settings.newton.skips.near_falls = nearby;
  return acting_settings(for_outcomes(settings, bridge), bridge);
}

std::vector<StageTask> tasks_of(const std::vector<Scene>& scenes, const Field& start) {
  std::vector<StageTask> tasks;
  for (const Scene& scene : scenes) tasks.push_back({.stage = {.scene = scene}, .start = &start});
  return tasks;
}

}  // namespace

TEST_CASE("What falls near the missing blocks falls in the whole bridge, to the same extent (its motions)",
          "[combined][patch][many-solutions]") {
  const Model bridge = test::reference_bridge();
  std::vector<Scene> scenes;
  for (const char* name : {"0,1", "0,4", "0,7", "0,10", "0,15", "11,10", "9,8", "12,10", "10,1", "6,4+8,1",
                           "11,4+11,3", "0,3+7,9"})
    scenes.push_back(parse_scene(name, bridge.layout));
  const Field intact = QuasiStaticSolver(bridge).solve(Scene{}).displacement;
  const std::vector<StageTask> tasks = tasks_of(scenes, intact);
  const auto whole = CombinedSolver(bridge, outcomes(bridge, false)).solve(tasks);
  const auto nearby = CombinedSolver(bridge, outcomes(bridge, true)).solve(tasks);
  const DynamicSolver motion(bridge);
  int found = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    INFO(to_string(scenes[i], bridge.layout));
    CHECK(nearby[i].outcome == whole[i].outcome);
    CHECK(nearby[i].extent == whole[i].extent);
    if (stands(whole[i])) CHECK(without_nan(nearby[i].displacement) == without_nan(whole[i].displacement));
    if (whole[i].outcome != Outcome::collapsed) continue;
    const auto fall = fall_nearby(tasks[i], motion, DecisionRules{});
    REQUIRE(fall);
    CHECK_FALSE(fall->moving.empty());
    ++found;
  }
  CHECK(found >= 6);
}

TEST_CASE(
    "Where a start has moved so far that only what is far away falls, the whole bridge says so (its motions)",
    "[combined][patch][many-solutions]") {
  const Model bridge = test::reference_bridge();
  const std::vector<Scene> scenes = {parse_scene("0,10", bridge.layout), parse_scene("0,4", bridge.layout)};
  const Field sagging = 10.0 * QuasiStaticSolver(bridge).solve(Scene{}).displacement;
  const std::vector<StageTask> tasks = tasks_of(scenes, sagging);
  const auto expected = CombinedSolver(bridge, outcomes(bridge, false)).solve(tasks);
  const auto found = CombinedSolver(bridge, outcomes(bridge, true)).solve(tasks);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    INFO(to_string(scenes[i], bridge.layout));
    CHECK(expected[i].outcome == Outcome::collapsed);
    CHECK(found[i].outcome == expected[i].outcome);
    CHECK(found[i].moving == expected[i].moving);
    CHECK(found[i].iterations == expected[i].iterations);
  }
}

TEST_CASE(
    "Nothing is looked for nearby without a start, of later stages, or where a patch is most "
    "of the bridge",
    "[combined][patch]") {
  const Model bridge = test::reference_bridge();
  const DynamicSolver motion(bridge);
  const Field start = Field::Zero(2, bridge.mesh.node_count());
  const State before{};
  const StageTask falls{.stage = {.scene = parse_scene("0,10", bridge.layout)}, .start = &start};
  REQUIRE(fall_nearby(falls, motion, DecisionRules{}));
  StageTask task = falls;
  task.start = nullptr;
  CHECK_FALSE(fall_nearby(task, motion, DecisionRules{}));
  task = falls;
  task.before = &before;
  CHECK_FALSE(fall_nearby(task, motion, DecisionRules{}));
  const Model small = test::small_bridge();
  const Field small_start = Field::Zero(2, small.mesh.node_count());
  const StageTask large{.stage = {.scene = parse_scene("0,4", small.layout)}, .start = &small_start};
  CHECK_FALSE(fall_nearby(large, DynamicSolver(small), DecisionRules{}));
}
