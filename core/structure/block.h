#pragma once
/// @file Blocks and the two ways to name one: by position in the layout, by index in the paper's notation.

#include <compare>
#include <cstdint>
#include <string>

#include "core/geometry/polygon.h"

namespace voussoir {

/// Position of a block in BlockLayout::blocks: arch blocks first (left to right), then course by course.
enum class BlockId : std::int32_t {};

constexpr int value(BlockId id) {
  return static_cast<int>(id);
}

/// The paper's (x1, x2): course (0 for the arch) and position from the left, counted through the opening,
/// from 1.
struct BlockIndex {
  int course = 0;
  int position = 0;
  friend auto operator<=>(const BlockIndex&, const BlockIndex&) = default;
};

/// "10,4"
std::string to_string(BlockIndex index);

/// What part a block plays; the mesh rule and the control points depend on it.
enum class BlockKind {
  leg,       ///< straight arch block below the springing
  voussoir,  ///< arch block of the semicircle
  plain,     ///< whole course rectangle
  cut        ///< course rectangle cut by an arch ring
};

struct Block {
  BlockIndex index;
  BlockKind kind = BlockKind::plain;
  Polygon polygon;          ///< [m], counter-clockwise
  bool top_course = false;  ///< belongs to the highest course
};

}  // namespace voussoir
