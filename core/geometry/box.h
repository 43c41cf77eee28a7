#pragma once
/// @file Boxes along the axes around points.

#include <Eigen/Geometry>

#include "core/geometry/polygon.h"

namespace voussoir {

using Box = Eigen::AlignedBox2d;

inline Box box_of(const Polygon& polygon) {
  Box box;
  for (const Point& corner : polygon) box.extend(corner);
  return box;
}

inline Box box_of(const std::vector<Polygon>& polygons) {
  Box box;
  for (const Polygon& polygon : polygons) box.extend(box_of(polygon));
  return box;
}

}  // namespace voussoir
