#pragma once
/// @file A block: a polygon with the part that it plays, and the names by which it is called.

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// What part a block plays in the bridge: whether its loss or movement is one of the arch, and which region's
/// material it has. Databases hold the numbers.
enum class BlockRole : std::uint8_t {
  wall = 0,      ///< spandrel wall
  ring = 1,      ///< arch ring, legs and skewback stones included
  pier = 2,      ///< between two spans
  abutment = 3,  ///< beside the outer spans
  parapet = 4,
  backing = 5,  ///< masonry over the haunches, behind the wall
  fill = 6      ///< soil or rubble over the ring
};

inline constexpr std::array<const char*, 7> kRoleNames = {"wall",    "ring",    "pier", "abutment",
                                                          "parapet", "backing", "fill"};

inline const char* name_of(BlockRole role) {
  return kRoleNames[static_cast<std::size_t>(role)];
}

/// The role of this name, or nothing.
std::optional<BlockRole> find_role(std::string_view name);

/// "wall, ring, ...", for messages.
std::string role_names();

/// How a block was cut out; the mesh rule depends on it.
enum class BlockKind : std::uint8_t {
  leg,       ///< stone below an end of the ring: straight leg, skewback
  voussoir,  ///< arch block with four corners: intrados from corner 1 to corner 2
  plain,     ///< whole course rectangle
  cut        ///< any other polygon
};

inline constexpr int kNoRing = -1;

struct Block {
  std::string label;  ///< what users call it, one for each block: "10,4"
  BlockRole role = BlockRole::wall;
  int ring = kNoRing;  ///< the ring that it belongs to, from 0: span by span, each from the intrados outwards
  BlockIndex index;
  BlockKind kind = BlockKind::cut;
  bool top_course = false;  ///< belongs to the highest course
  Polygon polygon;          ///< [m], counter-clockwise
  std::optional<std::array<Point, 2>>
      intrados{};  ///< [m] ends of its edge on the intrados, along the ring from
                   ///< the left. Databases keep the control points instead
};

/// Is this the block's label or the name of its role?
bool is_called(const Block& block, std::string_view name);

/// Gives blocks that are in the order of their courses their positions, from the left, and labels.
void number_by_courses(std::vector<Block>& blocks);

}  // namespace voussoir
