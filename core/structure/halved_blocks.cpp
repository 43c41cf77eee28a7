#include "core/structure/halved_blocks.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/box.h"

namespace voussoir {
namespace {

constexpr double kSame = 1e-6;  ///< [-] of a block's length

/// Courses of [[walls]] come after the wall's own.
bool is_of_wall(const Block& block, const WallDescription& wall) {
  return block.kind == BlockKind::plain && block.index.course > 0 && block.index.course <= wall.courses;
}

bool is_whole(const Block& block, const WallDescription& wall) {
  const double length = box_of(block.polygon).sizes().x();
  return is_of_wall(block, wall) && std::abs(length - wall.block_length) < kSame * wall.block_length;
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
      const Box box = box_of(block.polygon);
      const double middle = box.center().x();
      result.push_back(half(block, box.min().x(), middle));
      result.push_back(half(block, middle, box.max().x()));
    } else {
      result.push_back(block);
    }
  }
  number_by_courses(result);
  return result;
}

bool are_halves(const Block& first, const Block& second, const WallDescription& wall) {
  if (!wall.halved || first.index.course != second.index.course || !is_of_wall(first, wall) ||
      !is_of_wall(second, wall))
    return false;
  const Box both = box_of(first.polygon).merged(box_of(second.polygon));
  const bool shifted = wall.bond == Bond::running && first.index.course % 2 == 1;
  const double blocks_before = both.min().x() / wall.block_length - (shifted ? 0.5 : 0.0);
  return std::abs(both.sizes().x() - wall.block_length) < kSame * wall.block_length &&
         std::abs(blocks_before - std::round(blocks_before)) < kSame;
}

}  // namespace voussoir
