#pragma once
/// @file Wall blocks that can break in the middle: laid as two halves with a joint between them.

#include <vector>

#include "core/structure/block.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// Whole blocks of the wall's own courses (not of [[walls]]) cut in two by a vertical, if the wall says so;
/// the courses are numbered anew.
std::vector<Block> halved(std::vector<Block> blocks, const WallDescription& wall);

/// Are they the halves of one block?
bool are_halves(const Block& first, const Block& second, const WallDescription& wall);

}  // namespace voussoir
