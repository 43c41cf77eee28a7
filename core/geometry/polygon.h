#pragma once
/// @file Points and polygons in the plane, x to the right and y up, in metres.

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace voussoir {

using Point = Eigen::Vector2d;

/// A simple polygon by its corners, counter-clockwise, first corner not repeated.
using Polygon = std::vector<Point>;

/// z component of the cross product a x b.
inline double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Signed area [m2]: positive for counter-clockwise corners.
double area(const Polygon& polygon);

/// Centre of gravity [m]. Precondition: the area is not zero.
Point centroid(const Polygon& polygon);

/// Whether a point is inside; of one on the boundary either may be said.
bool contains(const Polygon& polygon, const Point& point);

/// The place between a and b nearest to a point, and the distance [m] from there.
Point nearest_on_segment(const Point& a, const Point& b, const Point& point);
double distance_to_segment(const Point& a, const Point& b, const Point& point);

/// Distance [m] of a point from the nearest edge, or corner, of a polygon.
double distance_to_boundary(const Polygon& polygon, const Point& point);
double distance_to_corner(const Polygon& polygon, const Point& point);

/// The height [m] of a polygon's highest point at x, or nothing beside it.
std::optional<double> highest_at(const Polygon& polygon, double x);

/// A place where the outline crosses or touches itself, or nothing.
std::optional<Point> self_crossing(const Polygon& polygon);

/// The parts of `subject` outside `hole`, each counter-clockwise, from left to right; parts with an area of
/// at most `smallest_area` [m2] are dropped, corners closer than a micrometre are merged and corners that lie
/// on the straight line between their neighbours are removed.
std::vector<Polygon> subtract(const Polygon& subject, const Polygon& hole, double smallest_area);

/// The union of two polygons that touch along edges: nothing unless it is one polygon without holes that
/// passes through no corner twice. Corners within a micrometre of each other, or of the other's edges, count
/// as lying there.
std::optional<Polygon> joined(const Polygon& first, const Polygon& second);

/// What of a convex polygon lies where `over`, linear in the place, is not positive: cut along a straight
/// line.
template <class Over>
Polygon clipped(const Polygon& polygon, Over over) {
  Polygon rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const double over_a = over(a), over_b = over(b);
    if (over_a <= 0.0) rest.push_back(a);
    if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0))
      rest.push_back(a + over_a / (over_a - over_b) * (b - a));
  }
  return rest;
}

/// What of a convex polygon lies where normal . place <= bound.
inline Polygon clipped(const Polygon& polygon, const Point& normal, double bound) {
  return clipped(polygon, [&](const Point& p) { return normal.dot(p) - bound; });
}

/// Mirror image across the vertical line at `axis_x`, counter-clockwise again.
Polygon mirrored(const Polygon& polygon, double axis_x);

}  // namespace voussoir
