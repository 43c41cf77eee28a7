#include "core/structure/neighbours.h"

#include <algorithm>
#include <set>

namespace voussoir {
namespace {

/// A block and those that touch it.
std::set<BlockId> surroundings(BlockId block, const Structure& structure) {
  std::set<BlockId> blocks = {block};
  for (const Joint& joint : structure.joints) {
    if (joint.first == block) blocks.insert(joint.second);
    if (joint.second == block) blocks.insert(joint.first);
  }
  return blocks;
}

}  // namespace

std::vector<BlockId> blocks_beside(const Scene& scene, const Structure& structure) {
  std::set<BlockId> beside;
  for (const BlockId block : scene.removed) beside.merge(surroundings(block, structure));
  for (const BlockId block : scene.removed) beside.erase(block);
  return {beside.begin(), beside.end()};
}

bool is_one_group(const Scene& scene, const Structure& structure) {
  std::vector<std::set<BlockId>> others;
  for (const BlockId block : scene.removed) others.push_back(surroundings(block, structure));
  if (others.empty()) return true;
  std::set<BlockId> group = std::move(others.back());
  others.pop_back();
  const auto meets_group = [&](const std::set<BlockId>& one) {
    return std::ranges::any_of(one, [&](BlockId block) { return group.contains(block); });
  };
  for (auto next = std::ranges::find_if(others, meets_group); next != others.end();
       next = std::ranges::find_if(others, meets_group)) {
    group.merge(*next);
    others.erase(next);
  }
  return others.empty();
}

}  // namespace voussoir
