#include "core/statics/mechanism.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/motion/dynamic_solver.h"
#include "core/statics/quasi_static_solver.h"
#include "tests/support/bridges.h"
#include "tools/validation/assemblies.h"

using namespace voussoir;
using validation::rectangle;

namespace {

constexpr BlockId kUpper{1};

/// A block of 1 x 0.5 m that hangs over the edge of one of the same size on the ground.
Model overhanging(double overhang) {
  BridgeDescription description;
  description.wall.length = 4.0;
  description.spans.clear();
  description.supports.sides = SupportKind::free;
  return validation::assemble_blocks(
      description, {rectangle(Point(1.0, 0.0), 1.0, 0.5), rectangle(Point(1.0 + overhang, 0.5), 1.0, 0.5)});
}

std::optional<Mechanism> mechanism_of(const Model& model, const Scene& scene, std::vector<BlockId> blocks) {
  return find_mechanism(model, Coefficients(EquilibriumSystem(model), model.parameters), scene, blocks);
}

}  // namespace

TEST_CASE("A block topples when its centre is beyond the edge that carries it (statics)", "[solver]") {
  for (const double overhang : {0.0, 0.3, 0.49})
    CHECK_FALSE(mechanism_of(overhanging(overhang), {}, {kUpper}));
  for (const double overhang : {0.6, 0.8}) {
    const auto topples = mechanism_of(overhanging(overhang), {}, {kUpper});
    REQUIRE(topples);
    CHECK(topples->blocks == std::vector{kUpper});
  }
}

TEST_CASE("A block whose support is gone falls freely: all of its weight does work (written out)",
          "[solver]") {
  const Model model = overhanging(0.0);
  const auto falls = mechanism_of(model, {{BlockId{0}}}, {kUpper});
  REQUIRE(falls);
  const double weight = 1.0 * 0.5 * model.parameters.blocks.front().density * model.parameters.gravity *
                        model.parameters.blocks.front().thickness;
  CHECK(falls->work.front() == Approx(weight * weight));
  CHECK(falls->load.front() == Approx(weight * weight));
  CHECK(falls->unbalanced.front() == Approx(0.5));  // of the weight of two blocks
}

TEST_CASE("Blocks that a support holds are in no mechanism", "[solver]") {
  CHECK_FALSE(mechanism_of(overhanging(0.8), {}, {BlockId{0}}));
}

TEST_CASE("A mechanism proves the falls of scenes that lack more, as long as what falls is there",
          "[solver]") {
  const Model model = overhanging(0.8);
  const auto topples = mechanism_of(model, {}, {kUpper});
  REQUIRE(topples);
  const std::vector<const Mechanism*> mechanisms = {&*topples};
  CHECK(proves_fall(*topples, {{BlockId{0}}}));
  CHECK_FALSE(proves_fall(*topples, {{kUpper}}));
  CHECK_FALSE(proved_fall(mechanisms, {{kUpper}}, model));
  const auto fallen = proved_fall(mechanisms, {}, model);
  REQUIRE(fallen);
  CHECK(fallen->outcome == Outcome::collapsed);
  CHECK(fallen->moving == std::vector{kUpper});
  CHECK(fallen->displacement.array().isNaN().all());

  const Mechanism of_a_loss = *mechanism_of(model, {{BlockId{0}}}, {kUpper});
  CHECK_FALSE(proves_fall(of_a_loss, {}));  // there the lower block carries it
}

TEST_CASE("No part of a bridge that stands has a mechanism (Newton's equilibrium)", "[solver]") {
  const Model bridge = test::small_bridge();
  std::vector<BlockId> blocks;
  for (int block = 0; block < bridge.block_count(); ++block) blocks.push_back(BlockId{block});
  REQUIRE(stands(QuasiStaticSolver(bridge).solve(Scene{})));
  CHECK_FALSE(mechanism_of(bridge, {}, blocks));
}

TEST_CASE("Of blocks beside missing ones only those that fall are said to (the motion from rest)",
          "[solver]") {
  const Model bridge = test::small_bridge();
  const Coefficients coefficients(EquilibriumSystem(bridge), bridge.parameters);
  const std::vector<Scene> singles = all_scenes(bridge.layout.blocks.size(), 1);
  const std::vector<DynamicSolution> motions = DynamicSolver(bridge).solve(singles);
  std::size_t proved = 0;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    const auto falls = find_mechanism_beside(bridge, coefficients, singles[i]);
    if (!falls) continue;
    ++proved;
    const Solution& motion = motions[i].solution;
    CAPTURE(to_string(singles[i], bridge.layout));
    REQUIRE(motion.outcome == Outcome::collapsed);
    CHECK(std::ranges::includes(motion.moving, falls->blocks));
    CHECK_FALSE(falls->blocks.empty());
  }
  CHECK(proved > 3);
  CHECK_FALSE(find_mechanism_beside(bridge, coefficients, Scene{}));
}
