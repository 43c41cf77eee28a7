#include "core/structure/exposed_edges.h"

#include <algorithm>

#include "core/geometry/facing_edges.h"

namespace voussoir {
namespace {

constexpr double kLevel = 1e-9;  ///< [m]

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

bool is_seen_from_above(const Block& block, const std::vector<Block>& blocks) {
  double top = block.polygon.front().y();
  for (const Point& p : block.polygon) top = std::max(top, p.y());
  double left = 0.0, right = 0.0;
  bool found = false;
  for (const Point& p : block.polygon) {
    if (p.y() < top - kLevel) continue;
    left = found ? std::min(left, p.x()) : p.x();
    right = found ? std::max(right, p.x()) : p.x();
    found = true;
  }
  if (right - left <= kLevel) return false;
  return std::none_of(blocks.begin(), blocks.end(), [&](const Block& other) {
    if (&other == &block) return false;
    const auto height = highest_at(other.polygon, 0.5 * (left + right));
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
