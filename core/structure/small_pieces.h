#pragma once
/// @file Stones as a mason lays them: what a ring cuts off a course in small pieces is left at a neighbour.
///
/// A piece of a hundredth of a block is no stone, and it makes a bridge slow to compute: the time step of a
/// collapse follows the smallest block.

#include <vector>

#include "core/structure/block.h"

namespace voussoir {

struct SmallPieces {
  int joined = 0;  ///< to a neighbour
  int left = 0;    ///< that have no neighbour in the wall
  friend bool operator==(const SmallPieces&, const SmallPieces&) = default;
};

/// Joins every block laid in courses with less than `smallest_area` [m2], the smallest first, to the block of
/// its role with which it shares the longest edge, as far as the union is one polygon without holes; two
/// equal neighbours of one course get half each. The union keeps the neighbour's place in the bond; edges
/// count as shared within `tolerance` [m].
SmallPieces join_small_pieces(std::vector<Block>& blocks, double smallest_area, double tolerance);

}  // namespace voussoir
