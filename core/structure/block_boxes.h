#pragma once
/// @file Boxes along the axes around blocks.

#include <map>
#include <vector>

#include "core/geometry/box.h"
#include "core/structure/block.h"

namespace voussoir {

/// Around all blocks.
Box box_of(const std::vector<Block>& blocks);

/// Around the blocks of each ring; blocks of no ring have one box as kNoRing.
std::map<int, Box> boxes_of_rings(const std::vector<Block>& blocks);

}  // namespace voussoir
