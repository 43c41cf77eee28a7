#include "core/geometry/overlap.h"

#include "core/geometry/triangulation.h"

namespace voussoir {
namespace {

std::vector<Polygon> triangles_of(const Polygon& polygon) {
  std::vector<Polygon> triangles;
  for (const auto& [a, b, c] : cut_between_corners(polygon).triangles)
    triangles.push_back({polygon[static_cast<std::size_t>(a)], polygon[static_cast<std::size_t>(b)],
                         polygon[static_cast<std::size_t>(c)]});
  return triangles;
}

Polygon common(Polygon polygon, const Polygon& triangle) {
  for (std::size_t i = 0; i < 3 && polygon.size() > 2; ++i) {
    const Point& from = triangle[i];
    const Point along = triangle[(i + 1) % 3] - from;
    polygon = clipped(polygon, [&](const Point& p) { return -cross(along, p - from); });
  }
  return polygon;
}

}  // namespace

Overlap overlap_of(const Polygon& first, const Polygon& second) {
  Overlap result;
  const std::vector<Polygon> others = triangles_of(second);
  for (const Polygon& one : triangles_of(first))
    for (const Polygon& other : others) {
      const Polygon both = common(one, other);
      const double size = both.size() > 2 ? area(both) : 0.0;
      if (size <= 0.0) continue;
      result.area += size;
      result.place += size * centroid(both);
    }
  if (result.area > 0.0) result.place /= result.area;
  return result;
}

}  // namespace voussoir
