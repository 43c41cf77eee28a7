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

/// How many figures of a database's digest people see.
inline constexpr std::size_t kDigestShown = 12;

/// "97.3 %", "< 0.1 %", "100 %" only for what is exactly one.
std::string percent(double share);
/// Of 1 - share, which may differ from 1 by less than numbers near 1 can.
std::string percent_of_others(double share);

}  // namespace voussoir
