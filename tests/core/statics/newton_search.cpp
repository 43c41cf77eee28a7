#include "core/statics/newton_search.h"

#include <catch2/catch.hpp>
#include <limits>

#include "core/motion/dynamic_solver.h"
#include "tests/support/bridges.h"
#include "tools/validation/assemblies.h"

using namespace voussoir;
using validation::rectangle;

namespace {

constexpr BlockId kHovering{1};

/// A block on the ground, and one of the same size a metre above it that touches nothing.
Model hovering_block() {
  BridgeDescription description;
  description.wall.length = 3.0;
  description.spans.clear();
  description.supports.sides = SupportKind::free;
  return validation::assemble_blocks(
      description, {rectangle(Point(1.0, 0.0), 1.0, 0.5), rectangle(Point(1.0, 1.5), 1.0, 0.5)});
}

}  // namespace

TEST_CASE("A block that touches nothing is not said to stand or to fall, and its field stays finite",
          "[solver]") {
  // Oracle: nothing carries the block's weight, and with no joint to bond the tangent stays singular.
  const Model bridge = hovering_block();
  REQUIRE(bridge.joints.empty());
  QuasiStaticSolver solver(bridge);
  const Field rest = Field::Zero(2, bridge.mesh.node_count());
  const std::vector<StageTask> tasks = {{.stage = {}},
                                        {.stage = {.scene = {{kHovering}}}},  // beside it in the lanes
                                        {.stage = {}, .start = &rest}};
  const std::vector<Solution> solutions = solver.solve(tasks);
  for (const std::size_t hovers : {std::size_t{0}, std::size_t{2}}) {
    CHECK(solutions[hovers].outcome == Outcome::unresolved);
    CHECK(solutions[hovers].displacement.allFinite());
    CHECK(solutions[hovers].residual > 0.1);  // the weight of the block is not carried
  }
  CHECK(solutions[1].outcome == Outcome::standing);
}

TEST_CASE("A search takes no step from a singular matrix, whatever stands in it", "[solver]") {
  // Oracle: the search stays where it began, at rest.
  const Model bridge = hovering_block();
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  const QuasiStaticSettings settings;
  Eigen::VectorXd tangent(system.pattern.nonZeros());
  for (const double useless : {1e-3, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    NewtonSearch search(StageEquations(system, coefficients, {}), settings, nullptr, {tangent.data()});
    while (!search.finished())
      search.advance(false, Eigen::VectorXd::Constant(system.unknown_count(), useless));
    INFO(useless);
    CHECK(search.solution().outcome == Outcome::unresolved);
    CHECK(search.solution().displacement == Field::Zero(2, bridge.mesh.node_count()));
  }
}

TEST_CASE("Searches without progress are given up, and nothing that stands is (searches to their end)",
          "[solver]") {
  const Model bridge = make_model(test::small_description());
  QuasiStaticSettings settings;
  settings.follow_falls = false;
  QuasiStaticSolver brief(bridge, settings);
  settings.skips.early_outcome = false;
  QuasiStaticSolver to_the_end(bridge, settings);
  std::vector<StageTask> tasks;
  for (const Scene& scene : all_scenes(bridge.layout.size(), 1))
    tasks.push_back({.stage = {.scene = scene}, .patient_phase = true});
  const std::vector<Solution> found = brief.solve(tasks), wanted = to_the_end.solve(tasks);
  int stand = 0, in_vain = 0, in_vain_to_the_end = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    INFO(to_string(tasks[i].stage.scene, bridge.layout));
    REQUIRE(found[i].outcome == wanted[i].outcome);
    if (wanted[i].outcome == Outcome::standing) {
      ++stand;
    } else {
      in_vain += found[i].iterations;
      in_vain_to_the_end += wanted[i].iterations;
    }
  }
  CHECK(stand > 20);
  CHECK(in_vain > 0);
  CHECK(in_vain < 3 * in_vain_to_the_end / 4);
}

TEST_CASE("Bolder steps find equilibria that the searches before them miss (slow motion)", "[solver]") {
  BridgeDescription description = test::small_description();
  description.joints.normal_stiffness = 3e9;
  description.joints.tangential_stiffness = 3e7;
  const Model bridge = make_model(description);
  const std::vector<Scene> scenes = {parse_scene("2,1", bridge.layout), parse_scene("4,6", bridge.layout)};

  QuasiStaticSettings settings;
  settings.follow_falls = false;
  QuasiStaticSolver solver(bridge, settings);
  settings.most_bold_iterations = 0;
  QuasiStaticSolver timid(bridge, settings);
  const Field intact = solver.solve(Scene{}).displacement;
  DynamicSettings slow;
  slow.ramp = 2.0;
  slow.decision.earliest_decision = slow.ramp;
  slow.decision.latest_decision = 8.0;
  slow.decision.standing_unbalance = 1e-7;
  const std::vector<DynamicSolution> motions = DynamicSolver(bridge, slow).solve(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    CAPTURE(to_string(scenes[i], bridge.layout));
    CHECK(timid.solve(scenes[i], intact).outcome == Outcome::unresolved);
    const Solution found = solver.solve(scenes[i], intact);
    REQUIRE(found.outcome == Outcome::standing);
    REQUIRE(motions[i].solution.outcome == Outcome::standing);
    const Field field = without_nan(found.displacement);
    const Field expected = without_nan(motions[i].solution.displacement);
    CHECK((field - expected).cwiseAbs().maxCoeff() < 0.005 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("Bolder steps in vain leave a search where it was (the search without them)", "[solver]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSettings settings;
  settings.follow_falls = false;
  QuasiStaticSolver solver(bridge, settings);
  settings.most_bold_iterations = 0;
  QuasiStaticSolver timid(bridge, settings);
  const Scene falls = parse_scene("0,3", bridge.layout);
  const Solution expected = timid.solve(falls);
  const Solution found = solver.solve(falls);
  REQUIRE(expected.outcome == Outcome::unresolved);
  CHECK(found.outcome == Outcome::unresolved);
  CHECK(found.iterations > expected.iterations);
  CHECK(without_nan(found.displacement) == without_nan(expected.displacement));
  CHECK(found.residual == Approx(expected.residual));
}
