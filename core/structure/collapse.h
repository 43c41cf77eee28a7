#pragma once
/// @file How much of a bridge moves away when a scene collapses.

#include <string_view>
#include <vector>

#include "core/structure/mesh.h"

namespace voussoir {

/// How much of the bridge moves away.
enum class CollapseExtent : std::uint8_t {
  none = 0,   ///< nothing moves away
  local = 1,  ///< wall blocks only: the ring carries on, and so do the readings elsewhere
  arch = 2    ///< blocks of the ring move away
};

/// "none", "local", "arch"
std::string_view to_string(CollapseExtent extent);

/// The extent of a collapse in which just these blocks move away.
CollapseExtent collapse_extent(const BlockLayout& layout, const std::vector<BlockId>& moving);

/// A block that has moved by this share of a mean block, or by so many sags of the bridge, is gone: what
/// drops into a gap comes to rest after one course, and softly if joints are soft.
inline constexpr double kGoneShare = 0.5;
inline constexpr double kGoneSags = 30.0;

/// Blocks of which a node has moved further than `distance` [m], ascending. Removed blocks, whose
/// displacement is NaN, are none of them.
std::vector<BlockId> blocks_moved_beyond(double distance, const Mesh& mesh, const Field& displacement);

}  // namespace voussoir
