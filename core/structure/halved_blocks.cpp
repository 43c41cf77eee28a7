#include "core/structure/halved_blocks.h"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

constexpr double kSame = 1e-6;  ///< [-] of a block's length

struct Extent {
  double left, right;
};

/// From the left to the right side of a block [m].
Extent extent(const Block& block) {
  const auto [left, right] =
      std::minmax_element(block.polygon.begin(), block.polygon.end(),
                          [](const Point& a, const Point& b) { return a.x() < b.x(); });
  return {left->x(), right->x()};
}

bool is_whole(const Block& block, const WallDescription& wall) {
  const Extent x = extent(block);
  return block.kind == BlockKind::plain && block.index.course > 0 &&
         std::abs(x.right - x.left - wall.block_length) < kSame * wall.block_length;
}

Block half(const Block& block, double left, double right) {
  Block part = block;
  for (Point& corner : part.polygon) corner.x() = std::clamp(corner.x(), left, right);
  return part;
}

}  // namespace

std::vector<Block> halved(std::vector<Block> blocks, const WallDescription& wall) {
  if (!wall.halved) return blocks;
  std::vector<Block> result;
  for (const Block& block : blocks) {
    if (is_whole(block, wall)) {
      const Extent x = extent(block);
      const double middle = 0.5 * (x.left + x.right);
      result.push_back(half(block, x.left, middle));
      result.push_back(half(block, middle, x.right));
    } else {
      result.push_back(block);
    }
  }
  BlockIndex last;
  for (Block& block : result) {
    last = {block.index.course, block.index.course == last.course ? last.position + 1 : 1};
    block.index = last;
    block.label = to_string(last);
  }
  return result;
}

bool are_halves(const Block& first, const Block& second, const WallDescription& wall) {
  if (!wall.halved || first.index.course != second.index.course || first.kind != BlockKind::plain ||
      second.kind != BlockKind::plain)
    return false;
  const Extent a = extent(first);
  const Extent b = extent(second);
  const double left = std::min(a.left, b.left);
  const double right = std::max(a.right, b.right);
  const bool shifted = wall.bond == Bond::running && first.index.course % 2 == 1;
  const double blocks_before = left / wall.block_length - (shifted ? 0.5 : 0.0);
  return std::abs(right - left - wall.block_length) < kSame * wall.block_length &&
         std::abs(blocks_before - std::round(blocks_before)) < kSame;
}

}  // namespace voussoir
