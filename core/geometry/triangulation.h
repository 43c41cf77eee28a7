#pragma once
/// @file Cutting one block into triangles.

#include <array>
#include <vector>

#include "core/geometry/polygon.h"

namespace voussoir {

/// Triangles over points; counter-clockwise corner numbers.
struct Triangulation {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
};

/// As few triangles as the corners allow (n - 2), with the best worst shape among all such triangulations;
/// ties go to the diagonal from the lowest, then leftmost corner.
Triangulation cut_between_corners(const Polygon& polygon);

/// Does no edge hide a corner from the centre of gravity?
bool centre_sees_corners(const Polygon& polygon);

/// Triangles from the centre of gravity to every edge. Precondition: the centre sees all corners.
Triangulation fan_about_centre(const Polygon& polygon);

/// Triangles from the middle of edge `edge` (corner `edge` to the next) to every other edge.
Triangulation fan_about_edge(const Polygon& polygon, int edge);

/// Puts a point onto the boundary edge that passes it within `tolerance` [m] and cuts that edge's triangle in
/// two, whose area stays; does nothing where a point is already.
void split_boundary_at(Triangulation& triangulation, const Point& point, double tolerance);

/// Every triangle cut into four at the middles of its edges; midpoints are shared.
Triangulation refined(const Triangulation& coarse);

/// Boundary edges (pairs of point numbers), counter-clockwise, in order round the block.
std::vector<std::array<int, 2>> boundary(const Triangulation& triangulation);

}  // namespace voussoir
