#pragma once
/// @file Blocks that are known to be missing from the start.

#include <string>
#include <vector>

#include "core/structure/block.h"

namespace voussoir {

/// A block that was gone before the bridge is looked at.
struct GoneBlock {
  std::size_t before = 0;  ///< the place of the next block that is left, among these
  Block block;
};

/// Takes these blocks out, each named as in a scene. They come back in the order in which they were there.
/// Throws InputError as parse_scene, and if no block is left.
std::vector<GoneBlock> take_out(const std::vector<std::string>& names, std::vector<Block>& blocks);

}  // namespace voussoir
