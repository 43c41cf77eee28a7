#pragma once
/// @file A block: a polygon with the part that it plays, and the names by which it is called.

#include <array>
#include <compare>
#include <cstdint>
#include <string>

#include "core/geometry/polygon.h"

namespace voussoir {

/// Position of a block in BlockLayout::blocks.
enum class BlockId : std::int32_t {};

constexpr int value(BlockId id) {
  return static_cast<int>(id);
}

/// Where a block lies in the bond, the paper's (x1, x2): course (0 for the arch) and position from the left,
/// counted through the opening, from 1. Blocks that are not laid in courses have course -1.
struct BlockIndex {
  int course = -1;
  int position = 0;
  friend auto operator<=>(const BlockIndex&, const BlockIndex&) = default;
};

/// "10,4"
std::string to_string(BlockIndex index);

/// What part a block plays in the bridge: whether its loss or movement is one of the arch.
enum class BlockRole : std::uint8_t {
  wall = 0,  ///< spandrel wall
  ring = 1   ///< arch ring, legs included
};

inline constexpr std::array<const char*, 2> kRoleNames = {"wall", "ring"};

inline const char* name_of(BlockRole role) {
  return kRoleNames[static_cast<std::size_t>(role)];
}

/// How a block was cut out; the mesh rule depends on it.
enum class BlockKind : std::uint8_t {
  leg,       ///< straight arch block below the springing
  voussoir,  ///< arch block of the semicircle: intrados from corner 1 to corner 2
  plain,     ///< whole course rectangle
  cut        ///< any other polygon
};

inline constexpr int kNoRing = -1;

struct Block {
  std::string label;  ///< what users call it, one for each block: "10,4"
  BlockRole role = BlockRole::wall;
  int ring = kNoRing;  ///< the ring (span) that it belongs to, from 0
  BlockIndex index;
  BlockKind kind = BlockKind::cut;
  bool top_course = false;  ///< belongs to the highest course
  Polygon polygon;          ///< [m], counter-clockwise
};

}  // namespace voussoir
