#pragma once
/// @file Blocks that are known to be missing from the start.

#include <string>
#include <vector>

#include "core/structure/block.h"

namespace voussoir {

/// Takes the blocks with these labels out. They come back in the order in which they were there. Throws
/// InputError for a label that no block has, one that comes twice, and if no block is left.
std::vector<GoneBlock> take_out(const std::vector<std::string>& labels, std::vector<Block>& blocks);

}  // namespace voussoir
