#pragma once
/// @file What two polygons have in common.

#include "core/geometry/polygon.h"

namespace voussoir {

struct Overlap {
  double area = 0.0;            ///< [m2]
  Point place = Point::Zero();  ///< [m] centre of what they have in common, if that has an area
};

/// Sums over the triangles of both, each pair clipped by straight cuts, so that edges that touch to round-off
/// give an area of round-off (Boost's intersection of such polygons can be far off). Precondition: simple,
/// counter-clockwise polygons.
Overlap overlap_of(const Polygon& first, const Polygon& second);

}  // namespace voussoir
