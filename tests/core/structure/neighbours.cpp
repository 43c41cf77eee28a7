#include "core/structure/neighbours.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

/// Of all blocks, by a look at every joint.
class Touching {
 public:
  explicit Touching(const Structure& bridge) : bridge_(bridge) {}

  bool touch(BlockId a, BlockId b) const {
    return std::ranges::any_of(bridge_.joints, [&](const Joint& joint) {
      return (joint.first == a && joint.second == b) || (joint.first == b && joint.second == a);
    });
  }

  bool touch_or_share(BlockId a, BlockId b) const {
    if (touch(a, b)) return true;
    for (int i = 0; i < bridge_.block_count(); ++i)
      if (touch(a, BlockId{i}) && touch(BlockId{i}, b)) return true;
    return false;
  }

 private:
  const Structure& bridge_;
};

}  // namespace

TEST_CASE("The blocks beside the missing ones touch one of them (joints, one by one)") {
  const Model bridge = test::small_bridge();
  const Touching joints(bridge);
  for (const Scene& scene : all_scenes(bridge.layout.blocks.size(), 2)) {
    std::vector<BlockId> expected;
    for (int i = 0; i < bridge.block_count(); ++i)
      if (!scene.lacks(BlockId{i}) && std::ranges::any_of(scene.removed, [&](BlockId missing) {
            return joints.touch(missing, BlockId{i});
          }))
        expected.push_back(BlockId{i});
    REQUIRE(blocks_beside(scene, bridge) == expected);
  }
}

TEST_CASE("Blocks are one group that touch each other or the same block (joints, one by one)") {
  const Model bridge = test::small_bridge();
  const Touching joints(bridge);
  std::size_t chains = 0;
  for (const Scene& scene : all_scenes(bridge.layout.blocks.size(), 3)) {
    const std::vector<BlockId>& blocks = scene.removed;
    if (blocks.size() < 2) {
      REQUIRE(is_one_group(scene, bridge));
      continue;
    }
    int linked = joints.touch_or_share(blocks[0], blocks[1]) ? 1 : 0;
    if (blocks.size() == 3)
      for (const std::size_t i : {0, 1}) linked += joints.touch_or_share(blocks[i], blocks[2]) ? 1 : 0;
    chains += blocks.size() == 3 && linked == 2 ? 1 : 0;
    REQUIRE(is_one_group(scene, bridge) == (linked >= scene.missing() - 1));
  }
  CHECK(chains > 100);  // the two ends of which are apart
}
