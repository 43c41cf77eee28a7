#include "core/structure/exposed_edges.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/facing_edges.h"

namespace voussoir {
namespace {

constexpr double kLevel = 1e-9;        ///< [m]
constexpr double kSteepestTop = 0.27;  ///< [-] 15 degrees

double touched_length(const Edge& edge, const Block& block, const std::vector<Block>& blocks,
                      double tolerance) {
  double length = 0.0;
  for (const Block& other : blocks) {
    if (&other == &block) continue;
    for (std::size_t i = 0; i < other.polygon.size(); ++i)
      if (const auto stretch = facing_stretch(
              edge, {other.polygon[i], other.polygon[(i + 1) % other.polygon.size()]}, tolerance))
        length += stretch->length;
  }
  return length;
}

}  // namespace

std::array<Point, 2> upper_face(const Block& block) {
  const Polygon& polygon = block.polygon;  // counter-clockwise: what looks up runs to the left
  const double steepest = block.role == BlockRole::ring ? 0.0 : kSteepestTop;
  const auto looks_up = [&](const Point& right, const Point& left) {
    return left.x() < right.x() &&
           std::abs(left.y() - right.y()) <= kLevel + steepest * (right.x() - left.x());
  };
  const std::size_t n = polygon.size();
  std::size_t left = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (polygon[i].y() > polygon[left].y()) left = i;
  std::size_t right = left;
  while (looks_up(polygon[left], polygon[(left + 1) % n])) left = (left + 1) % n;
  while (looks_up(polygon[(right + n - 1) % n], polygon[right])) right = (right + n - 1) % n;
  return {polygon[left], polygon[right]};
}

bool is_seen_from_above(const Block& block, const std::vector<Block>& blocks) {
  const auto [left, right] = upper_face(block);
  if (right.x() - left.x() <= kLevel) return false;
  const double middle = 0.5 * (left.x() + right.x());
  const double top = highest_at(block.polygon, middle).value();
  return std::none_of(blocks.begin(), blocks.end(), [&](const Block& other) {
    if (&other == &block) return false;
    const auto height = highest_at(other.polygon, middle);
    return height && *height > top + kLevel;
  });
}

std::optional<std::array<Point, 2>> open_face_towards(const Block& block, const std::vector<Block>& blocks,
                                                      const Point& point, double tolerance) {
  std::vector<Edge> edges;
  Point along_face = Point::Zero();
  for (std::size_t i = 0; i < block.polygon.size(); ++i) {
    const Edge edge{block.polygon[i], block.polygon[(i + 1) % block.polygon.size()]};
    const Point along = edge.to - edge.from;
    if (cross(along, point - edge.from) >= 0.0) continue;  // the block is on the edge's left
    if (touched_length(edge, block, blocks, tolerance) > 0.5 * along.norm()) continue;
    edges.push_back(edge);
    along_face += along;
  }
  if (edges.empty()) return std::nullopt;
  std::array<Point, 2> face = {edges.front().from, edges.front().from};
  for (const Edge& edge : edges)
    for (const Point& end : {edge.from, edge.to}) {
      if (along_face.dot(end - face.front()) < 0.0) face.front() = end;
      if (along_face.dot(end - face.back()) > 0.0) face.back() = end;
    }
  return face;
}

}  // namespace voussoir
