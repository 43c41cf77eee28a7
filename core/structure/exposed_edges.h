#pragma once
/// @file Which faces of blocks lie open: the top that carries traffic, the intrados that can be measured.

#include <array>
#include <optional>
#include <vector>

#include "core/structure/block.h"

namespace voussoir {

/// The ends of the block's upper face, left to right: from its highest corner along edges that rise by no
/// more than 15 degrees, as those of a graded or a surveyed parapet do; of arch blocks level ones alone, as
/// their backs are no place to stand on. Both are that corner if there is no such edge.
std::array<Point, 2> upper_face(const Block& block);

/// Has the block an upper face, and is no other block above the middle of it?
bool is_seen_from_above(const Block& block, const std::vector<Block>& blocks);

/// The ends of the block's open face towards a point, counter-clockwise about the block, which along a ring
/// is from its left foot to its right one: edges from whose line the point is seen outside the block and that
/// no other block touches within `tolerance` [m] along half their length. Nothing if there is none.
std::optional<std::array<Point, 2>> open_face_towards(const Block& block, const std::vector<Block>& blocks,
                                                      const Point& point, double tolerance);

}  // namespace voussoir
