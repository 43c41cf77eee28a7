#pragma once
/// @file Polygons as somebody drew them: corners that nearly meet are made to meet.

#include <vector>

#include "core/geometry/polygon.h"

namespace voussoir {

struct Snapping {
  int moved = 0;          ///< corners, and edges bent to a corner
  double farthest = 0.0;  ///< [m] that one was off
};

/// Moves corners that lie within `tolerance` [m] of another polygon's corner to one place, and bends edges
/// that pass a corner within it so that they pass through it: it becomes a corner of both. What was near then
/// meets exactly. Corners of one polygon that come to one place are joined.
Snapping snap(std::vector<Polygon>& polygons, double tolerance);

}  // namespace voussoir
