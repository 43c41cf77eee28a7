#pragma once
/// @file Blocks that are known to be missing from the start.

#include <string>
#include <vector>

#include "core/structure/block.h"

namespace voussoir {

/// Takes these blocks out, each named as in a scene. They come back in the order in which they were there.
/// Throws InputError as parse_scene, and if no block is left.
std::vector<GoneBlock> take_out(const std::vector<std::string>& names, std::vector<Block>& blocks);

}  // namespace voussoir
