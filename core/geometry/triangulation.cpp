#include "core/geometry/triangulation.h"

#include <algorithm>
#include <limits>
#include <map>

namespace voussoir {
namespace {

constexpr double kOnEdge = 1e-9;     ///< [m] points this close to an edge lie on it
constexpr double kTieMargin = 1e-9;  ///< relative: shapes that differ by round-off count as equal

/// Area over the sum of squared sides: 0.144 for an equilateral triangle, 0 or less for a flat or inverted
/// one.
double shape_quality(const Point& a, const Point& b, const Point& c) {
  return 0.5 * cross(b - a, c - a) / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

int lowest_leftmost(const Polygon& polygon) {
  int best = 0;
  for (int i = 1; i < static_cast<int>(polygon.size()); ++i) {
    const Point& p = polygon[static_cast<std::size_t>(i)];
    const Point& q = polygon[static_cast<std::size_t>(best)];
    if (p.y() < q.y() - kTieMargin || (p.y() <= q.y() + kTieMargin && p.x() < q.x())) best = i;
  }
  return best;
}

/// Best worst quality of the sub-polygons i..j, and the apex that achieves it (dynamic programming over
/// diagonals).
struct BestApex {
  double quality = std::numeric_limits<double>::infinity();
  int apex = -1;
};

class ApexTable {
 public:
  explicit ApexTable(const Polygon& corners)
      : n_(static_cast<int>(corners.size())), table_(corners.size() * corners.size()) {
    for (int span = 2; span < n_; ++span)
      for (int i = 0; i + span < n_; ++i) fill(corners, i, i + span);
  }
  const BestApex& at(int i, int j) const { return table_[static_cast<std::size_t>(i * n_ + j)]; }

 private:
  void fill(const Polygon& corners, int i, int j) {
    BestApex best{-std::numeric_limits<double>::infinity(), -1};
    for (int k = i + 1; k < j; ++k) {
      const auto p = [&](int c) -> const Point& { return corners[static_cast<std::size_t>(c)]; };
      const double quality = std::min({shape_quality(p(i), p(k), p(j)), at(i, k).quality, at(k, j).quality});
      if (best.apex < 0 || quality > best.quality + kTieMargin) best = {quality, k};
    }
    table_[static_cast<std::size_t>(i * n_ + j)] = best;
  }
  int n_;
  std::vector<BestApex> table_;
};

void collect(const ApexTable& table, int i, int j, int rotation, int n,
             std::vector<std::array<int, 3>>& triangles) {
  if (j - i < 2) return;
  const int k = table.at(i, j).apex;
  triangles.push_back({(i + rotation) % n, (k + rotation) % n, (j + rotation) % n});
  collect(table, i, k, rotation, n, triangles);
  collect(table, k, j, rotation, n, triangles);
}

}  // namespace

Triangulation cut_between_corners(const Polygon& polygon) {
  const int n = static_cast<int>(polygon.size());
  const int first = lowest_leftmost(polygon);
  Polygon rotated(polygon);
  std::rotate(rotated.begin(), rotated.begin() + first, rotated.end());
  Triangulation result{polygon, {}};
  collect(ApexTable(rotated), 0, n - 1, first, n, result.triangles);
  return result;
}

bool centre_sees_corners(const Polygon& polygon) {
  const Point centre = centroid(polygon);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& next = polygon[(i + 1) % polygon.size()];
    if (cross(polygon[i] - centre, next - centre) <= 0.0) return false;
  }
  return true;
}

Triangulation fan_about_centre(const Polygon& polygon) {
  const int n = static_cast<int>(polygon.size());
  Triangulation result{polygon, {}};
  result.points.push_back(centroid(polygon));
  for (int i = 0; i < n; ++i) result.triangles.push_back({i, (i + 1) % n, n});
  return result;
}

Triangulation fan_about_edge(const Polygon& polygon, int edge) {
  const int n = static_cast<int>(polygon.size());
  Triangulation result{polygon, {}};
  const auto corner = [&](int i) { return polygon[static_cast<std::size_t>(i % n)]; };
  result.points.push_back(0.5 * (corner(edge) + corner(edge + 1)));
  for (int i = 1; i < n; ++i) result.triangles.push_back({(edge + i) % n, (edge + i + 1) % n, n});
  return result;
}

void split_boundary_at(Triangulation& triangulation, const Point& point, double tolerance) {
  const auto at = [&](int i) -> const Point& { return triangulation.points[static_cast<std::size_t>(i)]; };
  for (const auto& [a, b] : boundary(triangulation)) {
    const Point foot = nearest_on_segment(at(a), at(b), point);
    const double off = (foot - point).norm();
    if (off > tolerance) continue;
    if ((at(a) - point).norm() <= tolerance || (at(b) - point).norm() <= tolerance) return;
    const int middle = static_cast<int>(triangulation.points.size());
    triangulation.points.push_back(off > kOnEdge ? foot : point);
    for (auto& t : triangulation.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] == a && t[(k + 1) % 3] == b) {
          const int apex = t[(k + 2) % 3];
          t = {a, middle, apex};
          triangulation.triangles.push_back({middle, b, apex});
          return;
        }
  }
}

Triangulation refined(const Triangulation& coarse) {
  Triangulation fine{coarse.points, {}};
  std::map<std::array<int, 2>, int> midpoints;
  const auto midpoint = [&](int a, int b) {
    const auto [entry, is_new] =
        midpoints.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(fine.points.size()));
    if (is_new)
      fine.points.push_back(
          0.5 * (coarse.points[static_cast<std::size_t>(a)] + coarse.points[static_cast<std::size_t>(b)]));
    return entry->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const int ab = midpoint(a, b);
    const int bc = midpoint(b, c);
    const int ca = midpoint(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

std::vector<std::array<int, 2>> boundary(const Triangulation& triangulation) {
  std::map<int, int> next;  // of the directed edges without a partner
  std::map<std::array<int, 2>, int> directed;
  for (const auto& t : triangulation.triangles)
    for (std::size_t k = 0; k < 3; ++k) directed[{t[k], t[(k + 1) % 3]}] = 1;
  for (const auto& [edge, unused] : directed)
    if (!directed.contains({edge[1], edge[0]})) next[edge[0]] = edge[1];

  std::vector<std::array<int, 2>> edges;
  for (int from = next.begin()->first; edges.size() < next.size(); from = next.at(from))
    edges.push_back({from, next.at(from)});
  return edges;
}

}  // namespace voussoir
