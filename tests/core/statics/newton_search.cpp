#include "core/statics/newton_search.h"

#include <catch2/catch.hpp>
#include <limits>

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
