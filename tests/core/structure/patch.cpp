/// @file Patches of bridges. Oracles: ways over joints, one by one; the whole bridge.

#include "core/structure/patch.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/statics/quasi_static_solver.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

std::vector<BlockId> in_bridge(const std::vector<BlockId>& blocks, const Patch& patch) {
  std::vector<BlockId> result;
  for (const BlockId block : blocks) result.push_back(patch.blocks[static_cast<std::size_t>(value(block))]);
  return result;
}

/// Of each block, how many joints away the nearest missing one is.
std::vector<int> distances(const Scene& scene, const Structure& bridge) {
  std::vector<int> distance(bridge.layout.size(), bridge.block_count());
  for (const BlockId block : scene.removed) distance[static_cast<std::size_t>(value(block))] = 0;
  for (int round = 0; round < bridge.block_count(); ++round)
    for (const Joint& joint : bridge.joints) {
      int& first = distance[static_cast<std::size_t>(value(joint.first))];
      int& second = distance[static_cast<std::size_t>(value(joint.second))];
      first = std::min(first, second + 1);
      second = std::min(second, first + 1);
    }
  return distance;
}

std::vector<BlockId> blocks_from_to(int least, int most, const std::vector<int>& distance) {
  std::vector<BlockId> blocks;
  for (std::size_t b = 0; b < distance.size(); ++b)
    if (distance[b] >= least && distance[b] <= most) blocks.push_back(BlockId{static_cast<int>(b)});
  return blocks;
}

}  // namespace

TEST_CASE(
    "A patch has all blocks within so many neighbours, and those beside them as its rim (ways over joints)",
    "[patch]") {
  const Model bridge = test::small_bridge();
  for (const Scene& scene : all_scenes(bridge.layout.size(), 2)) {
    if (scene.removed.empty()) continue;
    const std::vector<int> distance = distances(scene, bridge);
    for (const int neighbours : {0, 1, 2}) {
      const Patch patch = patch_around(scene, neighbours, bridge);
      REQUIRE(patch.blocks == blocks_from_to(0, neighbours + 1, distance));
      REQUIRE(in_bridge(patch.rim, patch) == blocks_from_to(neighbours + 1, neighbours + 1, distance));
      REQUIRE(in_bridge(patch.scene_of(scene).removed, patch) == scene.removed);
      REQUIRE(patch.share_of_blocks() == Approx(double(patch.blocks.size()) / bridge.block_count()));
    }
  }
}

TEST_CASE("Missing blocks outside a patch are not missing in it", "[patch]") {
  const Model bridge = test::small_bridge();
  const Scene far = parse_scene("1,1+5,5", bridge.layout);
  const Patch patch = patch_around(parse_scene("5,5", bridge.layout), 1, bridge);
  CHECK(in_bridge(patch.scene_of(far).removed, patch) == parse_scene("5,5", bridge.layout).removed);
}

TEST_CASE("A patch with everything in it is the bridge (same bits)", "[patch]") {
  BridgeDescription description = test::small_description();
  description.fill = {.unit_weight = 18e3, .surface = {Point(0.0, 3.0), Point(6.0, 3.0)}};
  const Model bridge = make_model(description);
  const Scene scene = parse_scene("5,3", bridge.layout);
  const Patch patch = patch_around(scene, bridge.block_count(), bridge);
  CHECK(patch.rim.empty());
  const Solution whole = QuasiStaticSolver(bridge).solve(scene);
  const Solution in_patch = QuasiStaticSolver(patch.model).solve(patch.scene_of(scene));
  REQUIRE(stands(whole));
  CHECK(without_nan(in_patch.displacement) == without_nan(whole.displacement));
}

TEST_CASE("Where the rim goes along, blocks of a patch are where they are in the bridge (its equilibrium)",
          "[patch]") {
  const Model bridge = test::reference_bridge();
  const Field intact = QuasiStaticSolver(bridge).solve(Scene{}).displacement;
  for (const char* name : {"10,4", "0,10", "1,1", "12,20"}) {
    INFO(name);
    const Patch patch = patch_around(parse_scene(name, bridge.layout), 2, bridge);
    const Field expected = patch.field_of(intact);
    const Solution found = QuasiStaticSolver(patch.model).solve({.stage = {.support_movement = expected}});
    REQUIRE(stands(found));
    CHECK((found.displacement - expected).cwiseAbs().maxCoeff() < 1e-9);
    const Solution unmoved = QuasiStaticSolver(patch.model).solve(Scene{});
    CHECK((unmoved.displacement - expected).cwiseAbs().maxCoeff() > 1e-5);
  }
}
