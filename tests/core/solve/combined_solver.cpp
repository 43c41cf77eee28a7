#include "core/solve/combined_solver.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/statics/equilibrium.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

std::vector<StageTask> from_rest(const std::vector<Scene>& scenes) {
  std::vector<StageTask> tasks;
  for (const Scene& scene : scenes) tasks.push_back({.stage = {.scene = scene}});
  return tasks;
}

/// 40 blocks; the intact bridge sags 24 mm, ten times as far as with bonded joints.
Model sagging_bridge() {
  BridgeDescription bridge;
  SpanDescription& span = bridge.spans.front();
  bridge.spans.resize(1);
  span.intrados_radius = 1.1515705926123987;
  span.ring_thickness = 0.16014603801677468;
  span.centre_x = 2.1296521865779319;
  span.centre_y = 1.2395931233283459;
  span.voussoirs = 18;
  bridge.wall.length = 2.0 * span.centre_x;
  bridge.wall.courses = 8;
  bridge.wall.course_height = 0.51385339933469076;
  bridge.wall.block_length = 1.4125324793103733;
  bridge.wall.bond = Bond::stack;
  bridge.wall.smallest_block = 0.1;
  bridge.material.young_modulus = 5.927e9;
  bridge.joints.normal_stiffness = 1.258e8;
  bridge.joints.tangential_stiffness = 1.266e9;
  bridge.joints.friction_angle = 0.471041088674516;
  return make_model(bridge);
}

}  // namespace

TEST_CASE("A bridge that sags far before it rests does not fall (equilibrium from the field)", "[combined]") {
  const Model bridge = sagging_bridge();
  CombinedSolver solver(bridge);
  const Solution intact = solver.solve(from_rest({Scene{}})).front();
  REQUIRE(stands(intact));
  CHECK(unbalanced_force(bridge, {}, intact.displacement) < 1e-7);
  CHECK(intact.displacement.cwiseAbs().maxCoeff() > 0.02);

  // In plain explicit motion these come to rest, too, and (6,1) falls.
  for (const char* const name : {"2,2", "3,1", "6,1"}) {
    INFO(name);
    const Scene scene = parse_scene(name, bridge.layout);
    const Solution found =
        solver.solve(std::vector<StageTask>{{.stage = {.scene = scene}, .start = &intact.displacement}})
            .front();
    CHECK(found.outcome == (name[0] == '6' ? Outcome::collapsed : Outcome::standing));
    if (stands(found)) CHECK(unbalanced_force(bridge, scene, found.displacement, found.slipped) < 1e-7);
  }
}

TEST_CASE("What friction holds where it has slid stands with that slip (equilibrium, plain explicit motion)",
          "[combined]") {
  const Model bridge = make_model(test::sliding_description());
  DynamicSettings plain;
  plain.integrator = Integrator::central_differences;
  DynamicSolver motion(bridge, plain);
  for (const char* const name : {"5,3", "5,5"}) {  // mirror images of each other
    INFO(name);
    const Scene scene = parse_scene(name, bridge.layout);
    const Solution found = CombinedSolver(bridge).solve(from_rest({scene})).front();
    REQUIRE(stands(found));
    REQUIRE(has_slipped(found));
    CHECK(unbalanced_force(bridge, scene, found.displacement, found.slipped) < 1e-7);
    CHECK(unbalanced_force(bridge, scene, found.displacement) > 1e-2);
    CHECK_FALSE(stands(QuasiStaticSolver(bridge).solve(scene)));

    DecisionRules rules = patient_rules(DecisionRules{});
    rules.freer_until = rules.freer_from;
    const DynamicSolution moved = motion.solve(std::span(&scene, 1), far_fall_rules(rules)).front();
    CHECK(stands(moved.solution));
    const Field difference = without_nan(moved.solution.displacement - found.displacement);
    CHECK(difference.cwiseAbs().maxCoeff() < 0.1 * motion.sag());
  }
}

TEST_CASE(
    "Newton's far steps are no falls: a bridge on soft joints stands where it was found (the same field)",
    "[combined]") {
  const Model bridge = make_model(test::soft_description());
  const Solution intact = CombinedSolver(bridge).solve(from_rest({Scene{}})).front();
  REQUIRE(stands(intact));
  REQUIRE(intact.displacement.cwiseAbs().maxCoeff() > QuasiStaticSettings{}.collapse_displacement);
  QuasiStaticSettings descending;
  descending.patient_first = true;
  const Solution again = QuasiStaticSolver(bridge, descending).solve(Scene{}, intact.displacement);
  REQUIRE(stands(again));
  CHECK(again.iterations <= 1);
}

TEST_CASE(
    "Whatever falls has fallen in motion, however soon Newton's search takes a step for a fall (motion)",
    "[combined]") {
  BridgeDescription stiff_along = test::small_description();
  stiff_along.joints.tangential_stiffness = 10.0 * stiff_along.joints.normal_stiffness;
  for (const BridgeDescription& description : {test::soft_description(), stiff_along}) {
    const Model bridge = make_model(description);
    SolverSettings hasty = acting_settings(SolverSettings::of(SolverKind::quasi_static), bridge);
    hasty.newton.collapse_displacement = 1e-6;
    std::vector<Scene> singles = all_scenes(bridge.layout.size(), 1);
    singles.erase(singles.begin());
    const std::vector<Solution> solutions = CombinedSolver(bridge, hasty).solve(from_rest(singles));
    DynamicSolver motion(bridge);
    const auto soon = motion.solve(singles);
    const auto late = motion.solve(singles, patient_rules(DecisionRules{}));
    int fallen = 0;
    for (std::size_t i = 0; i < singles.size(); ++i) {
      if (solutions[i].outcome != Outcome::collapsed) continue;
      const bool at_once = soon[i].solution.outcome == Outcome::collapsed;
      CHECK(solutions[i].moving == (at_once ? soon : late)[i].solution.moving);
      CHECK(solutions[i].iterations == (at_once ? soon : late)[i].solution.iterations);
      ++fallen;
    }
    CHECK(fallen > 10);
  }
}

TEST_CASE("Every scene of the small bridge with up to one block missing has an outcome", "[combined]") {
  const Model bridge = test::small_bridge();
  const std::vector<Scene> scenes = all_scenes(bridge.layout.size(), 1);
  const std::vector<Solution> solutions = CombinedSolver(bridge).solve(from_rest(scenes));
  int standing = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    INFO(to_string(scenes[i], bridge.layout));
    CHECK(solutions[i].outcome != Outcome::unresolved);
    if (solutions[i].outcome != Outcome::standing) continue;
    // Oracle: equilibrium recomputed from the field alone.
    CHECK(unbalanced_force(bridge, scenes[i], solutions[i].displacement, solutions[i].slipped) < 1e-7);
    ++standing;
  }
  CHECK(standing >= 20);
  CHECK(standing < static_cast<int>(scenes.size()));
}

TEST_CASE("Joints as stiff along as across, or stiffer: no scene is left open (equilibrium from the field)",
          "[combined][many-solutions]") {
  BridgeDescription description = test::small_description();
  for (const double ratio : {1.0, 3.0}) {
    description.joints.tangential_stiffness = ratio * description.joints.normal_stiffness;
    const Model bridge = make_model(description);
    const std::vector<Scene> scenes = all_scenes(bridge.layout.size(), 1);
    const std::vector<Solution> solutions = CombinedSolver(bridge).solve(from_rest(scenes));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      INFO(to_string(scenes[i], bridge.layout) << " with p_t / p_n = " << ratio);
      CHECK(solutions[i].outcome != Outcome::unresolved);
      if (stands(solutions[i]))
        CHECK(unbalanced_force(bridge, scenes[i], solutions[i].displacement, solutions[i].slipped) < 1e-7);
    }
    CHECK(std::ranges::count_if(solutions, stands) > 20);
  }
}

TEST_CASE("A patient search finds the equilibrium that rising p_t leads to step by step (continuation)",
          "[combined][many-solutions]") {
  BridgeDescription description = reference_bridge_file().description;
  description.joints.normal_stiffness = description.joints.tangential_stiffness = 1e8;
  const Model bridge = make_model(description);
  QuasiStaticSolver newton(bridge);
  const Solution patient = newton.solve(StageTask{.stage = {}, .patient_phase = true});
  REQUIRE(stands(patient));

  Solution followed;
  for (int step = 0; step <= 60; ++step) {
    Parameters parameters = bridge.parameters;
    for (JointMaterial& joint : parameters.joints)
      joint.tangential_stiffness *= std::pow(0.1, 1.0 - step / 60.0);
    followed = newton.solve(
        {.stage = {}, .start = step > 0 ? &followed.displacement : nullptr, .parameters = &parameters});
    REQUIRE(stands(followed));
  }
  CHECK((followed.displacement - patient.displacement).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("Scenes that Newton alone leaves open stand or creep away in motion",
          "[combined][many-solutions]") {
  const Model bridge = test::reference_bridge();
  const std::vector<std::pair<const char*, Outcome>> expected =
      {
          {"intact", Outcome::standing},       {"11,8", Outcome::standing},  // little progress in three steps
          {"0,15", Outcome::collapsed},        {"0,15+7,10", Outcome::collapsed},
          {"10,17+10,18", Outcome::collapsed}, {"8,2+8,3", Outcome::collapsed},
          {"1,6+10,1", Outcome::collapsed},  // creeps: friction holds all but a ten thousandth of the weight
      };
  std::vector<Scene> scenes;
  for (const auto& [name, outcome] : expected) scenes.push_back(parse_scene(name, bridge.layout));
  const std::vector<Solution> solutions = CombinedSolver(bridge).solve(from_rest(scenes));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO(expected[i].first);
    CHECK(solutions[i].outcome == expected[i].second);
  }
}

TEST_CASE("Scenes that are said to fall have the same answers, whether they do or not (Newton first)",
          "[combined][many-solutions]") {
  const Model bridge = test::reference_bridge();
  std::vector<StageTask> tasks;
  for (const char* text : {"0,15", "0,15+7,10", "8,1+9,1", "10,4", "1,6+10,1"})
    tasks.push_back({.stage = {.scene = parse_scene(text, bridge.layout)}});
  CombinedSolver solver(bridge);
  const std::vector<Solution> expected = solver.solve(tasks);
  for (StageTask& task : tasks) task.hints.falls_likely = true;
  const std::vector<Solution> found = solver.solve(tasks);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    INFO(to_string(tasks[i].stage.scene, bridge.layout));
    CHECK(found[i].outcome == expected[i].outcome);
    CHECK(found[i].moving == expected[i].moving);
    const Field difference = found[i].displacement - expected[i].displacement;
    CHECK(difference.array().isNaN().select(0.0, difference).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE(
    "Scenes that are said to have no answer get what is found without patient searches (Newton, one motion)",
    "[combined][many-solutions]") {
  const Model bridge = test::reference_bridge();
  std::vector<StageTask> tasks;
  for (const char* text :
       {"10,4", "0,15", "10,1+11,9"})  // stands, falls, creeps: only the long motion sees it move
    tasks.push_back({.stage = {.scene = parse_scene(text, bridge.layout)}});
  CombinedSolver solver(bridge);
  const std::vector<Solution> patient = solver.solve(tasks);
  for (StageTask& task : tasks) task.hints.open_likely = true;
  const std::vector<Solution> brief = solver.solve(tasks);
  CHECK(patient[2].outcome == Outcome::collapsed);
  CHECK(brief[2].outcome == Outcome::unresolved);
  for (const std::size_t i : {0, 1}) {
    CHECK(brief[i].outcome == patient[i].outcome);
    CHECK(without_nan(brief[i].displacement) == without_nan(patient[i].displacement));
  }
}

TEST_CASE("The combined solver's answers do not depend on their company, to the last bit", "[combined]") {
  const Model bridge = test::small_bridge();
  CombinedSolver solver(bridge);
  const std::vector<Scene> scenes = all_scenes(bridge.layout.size(), 1);
  const std::vector<Solution> together = solver.solve(from_rest(scenes));
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{7}, scenes.size() - 1}) {
    const Solution alone = solver.solve(from_rest({scenes[i]})).front();
    CHECK(alone.outcome == together[i].outcome);
    CHECK(without_nan(alone.displacement) == without_nan(together[i].displacement));
  }
}
