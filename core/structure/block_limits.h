#pragma once
/// @file How many blocks, and how large, a bridge file or a file of blocks may hold.

#include <cstddef>

namespace voussoir {

inline constexpr std::size_t kMostBlocks = 20'000;
inline constexpr std::size_t kMostCorners = 200;  ///< of a block
inline constexpr std::size_t kLongestLabel = 31;  ///< bytes of a block's
inline constexpr int kMostRings = 1000;
inline constexpr double kLargestLength = 1e5;  ///< [m] of anything, and from the origin to any corner

}  // namespace voussoir
