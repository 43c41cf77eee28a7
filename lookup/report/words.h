#pragma once
/// @file Blocks and numbers in plain words.

#include <string>

#include "core/structure/block_layout.h"
#include "core/structure/scene.h"

namespace voussoir {

/// "course 10, 4th from the left, x 3..4 m, y 4.5..5 m", "voussoir 15 of 19 of the arch, x ..".
std::string place_in_words(BlockId block, const BlockLayout& layout);

/// The places of all missing blocks, or "no block is missing".
std::string place_in_words(const Scene& scene, const BlockLayout& layout);

/// "1st", "2nd", "11th"...
std::string ordinal(int number);

/// "97.3 %"; "< 0.1 %" and "> 99.9 %" at the ends, as nothing is known to be impossible or certain.
std::string percent(double share);

}  // namespace voussoir
