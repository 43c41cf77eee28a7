#include "core/geometry/polygon.h"

// Boost's default snaps coordinates to an integer grid of about a micrometre; plain doubles keep round-off
// only.
#define BOOST_GEOMETRY_NO_ROBUSTNESS

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace voussoir {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint, /*ClockWise=*/false, /*Closed=*/true>;

constexpr double kMergeDistance =
    1e-6;  ///< [m] a micrometre: far below masonry tolerances, far above round-off.

BoostPolygon to_boost(const Polygon& polygon) {
  BoostPolygon result;
  for (const Point& p : polygon) bg::append(result.outer(), BoostPoint(p.x(), p.y()));
  bg::correct(result);
  return result;
}

/// Removes corners that repeat their predecessor or lie on the line through their neighbours.
Polygon without_idle_corners(const Polygon& polygon) {
  Polygon distinct;
  for (const Point& p : polygon)
    if (distinct.empty() || (p - distinct.back()).norm() > kMergeDistance) distinct.push_back(p);
  while (distinct.size() > 1 && (distinct.front() - distinct.back()).norm() <= kMergeDistance)
    distinct.pop_back();

  Polygon corners;
  const std::size_t n = distinct.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point& before = distinct[(i + n - 1) % n];
    const Point& after = distinct[(i + 1) % n];
    const double off_line = std::abs(cross(distinct[i] - before, after - before)) / (after - before).norm();
    if (off_line > kMergeDistance) corners.push_back(distinct[i]);
  }
  return corners;
}

/// The number of a corner among those that are known; a new one if none is near.
int number_of(const Point& point, std::vector<Point>& corners) {
  const auto known = static_cast<int>(corners.size());
  for (int i = 0; i < known; ++i)
    if ((corners[static_cast<std::size_t>(i)] - point).norm() <= kMergeDistance) return i;
  corners.push_back(point);
  return known;
}

/// The polygon's outline by the numbers of its corners, with those corners of the other that lie on it.
std::vector<int> with_corners_of(const Polygon& polygon, const Polygon& other, std::vector<Point>& corners) {
  std::vector<int> outline;
  const auto append = [&](const Point& point) {
    const int number = number_of(point, corners);
    if (outline.empty() || outline.back() != number) outline.push_back(number);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& from = polygon[i];
    const Point& to = polygon[(i + 1) % polygon.size()];
    Polygon between;
    for (const Point& corner : other)
      if (distance_to_segment(from, to, corner) <= kMergeDistance) between.push_back(corner);
    std::sort(between.begin(), between.end(), [&](const Point& a, const Point& b) {
      return (a - from).squaredNorm() < (b - from).squaredNorm();
    });
    append(from);
    for (const Point& corner : between) append(corner);
  }
  while (outline.size() > 1 && outline.back() == outline.front()) outline.pop_back();
  return outline;
}

}  // namespace

double area(const Polygon& polygon) {
  double twice = 0.0;
  const Point& origin = polygon.front();  // differences keep precision far from the coordinate origin
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - origin, polygon[i + 1] - origin);
  return 0.5 * twice;
}

Point centroid(const Polygon& polygon) {
  const Point& origin = polygon.front();
  Point moment = Point::Zero();
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point a = polygon[i] - origin;
    const Point b = polygon[i + 1] - origin;
    moment += cross(a, b) * (a + b) / 3.0;
    twice += cross(a, b);
  }
  return origin + moment / twice;
}

bool contains(const Polygon& polygon, const Point& point) {
  bool inside = false;  // an odd number of edges crosses the way from the point to the right
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

Point nearest_on_segment(const Point& a, const Point& b, const Point& point) {
  const double t = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return a + t * (b - a);
}

double distance_to_segment(const Point& a, const Point& b, const Point& point) {
  return (nearest_on_segment(a, b, point) - point).norm();
}

double distance_to_boundary(const Polygon& polygon, const Point& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    nearest = std::min(nearest, distance_to_segment(polygon[j], polygon[i], point));
  return nearest;
}

double distance_to_corner(const Polygon& polygon, const Point& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point& corner : polygon) nearest = std::min(nearest, (corner - point).norm());
  return nearest;
}

std::optional<double> highest_at(const Polygon& polygon, double x) {
  std::optional<double> highest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    if ((a.x() - x) * (b.x() - x) > 0.0 || a.x() == b.x()) continue;
    const double y = a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
    highest = std::max(highest.value_or(y), y);
  }
  return highest;
}

std::optional<Point> self_crossing(const Polygon& polygon) {
  constexpr double kTouching = 1e-9;  // [m]
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      const Point &a = polygon[i], &b = polygon[i + 1], &c = polygon[j], &d = polygon[(j + 1) % n];
      for (const auto& [from, to, point] :
           {std::tuple(a, b, c), std::tuple(a, b, d), std::tuple(c, d, a), std::tuple(c, d, b)})
        if (distance_to_segment(from, to, point) < kTouching) return point;
      const double of_c = cross(b - a, c - a), of_d = cross(b - a, d - a);
      if (of_c * of_d < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0)
        return c + of_c / (of_c - of_d) * (d - c);
    }
  return std::nullopt;
}

std::vector<Polygon> subtract(const Polygon& subject, const Polygon& hole, double smallest_area) {
  std::vector<BoostPolygon> remains;
  bg::difference(to_boost(subject), to_boost(hole), remains);

  std::vector<Polygon> parts;
  for (const BoostPolygon& remain : remains) {
    Polygon part;
    for (const BoostPoint& p : remain.outer()) part.emplace_back(p.x(), p.y());
    part = without_idle_corners(part);
    if (part.size() >= 3 && area(part) > smallest_area) parts.push_back(part);
  }
  std::sort(parts.begin(), parts.end(),
            [](const Polygon& a, const Polygon& b) { return centroid(a).x() < centroid(b).x(); });
  return parts;
}

std::optional<Polygon> joined(const Polygon& first, const Polygon& second) {
  // A place where the two have an edge in opposite directions lies inside the union: both edges go.
  std::vector<Point> corners;
  std::map<std::pair<int, int>, int> edges;
  bool touch = false;
  for (const auto& [polygon, other] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    const std::vector<int> outline = with_corners_of(*polygon, *other, corners);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const std::pair edge(outline[i], outline[(i + 1) % outline.size()]);
      if (edges.erase({edge.second, edge.first}) > 0)
        touch = true;
      else
        ++edges[edge];
    }
  }
  std::map<int, int> next;
  for (const auto& [edge, times] : edges)
    if (times > 1 || !next.emplace(edge).second) return std::nullopt;
  if (!touch || next.empty()) return std::nullopt;
  Polygon outline;
  int corner = next.begin()->first;
  do {
    outline.push_back(corners[static_cast<std::size_t>(corner)]);
    const auto found = next.find(corner);
    if (found == next.end()) return std::nullopt;
    corner = found->second;
  } while (corner != next.begin()->first && outline.size() <= next.size());
  if (outline.size() != next.size()) return std::nullopt;
  return without_idle_corners(outline);
}

Polygon mirrored(const Polygon& polygon, double axis_x) {
  Polygon image;
  for (auto p = polygon.rbegin(); p != polygon.rend(); ++p) image.emplace_back(2.0 * axis_x - p->x(), p->y());
  return image;
}

}  // namespace voussoir
