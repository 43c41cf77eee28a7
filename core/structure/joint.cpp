#include "core/structure/joint.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace voussoir {
namespace {

struct PlacedEdge {
  BlockId block;
  BoundaryEdge edge;
  Point from;
  Point to;
  double left() const { return std::min(from.x(), to.x()); }
  double right() const { return std::max(from.x(), to.x()); }
};

std::vector<PlacedEdge> edges_by_left_end(const Mesh& mesh) {
  std::vector<PlacedEdge> edges;
  for (std::size_t block = 0; block < mesh.block_edges.size(); ++block)
    for (int e = mesh.block_edges[block].begin; e < mesh.block_edges[block].end; ++e) {
      const BoundaryEdge& edge = mesh.edges[static_cast<std::size_t>(e)];
      edges.push_back({BlockId{static_cast<std::int32_t>(block)}, edge, mesh.position(edge.from),
                       mesh.position(edge.to)});
    }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const auto& a, const auto& b) { return a.left() < b.left(); });
  return edges;
}

/// The stretch in which two edges run against each other, or nothing.
std::optional<Joint> facing_stretch(const PlacedEdge& a, const PlacedEdge& b, double tolerance) {
  const Point along = a.to - a.from;
  const double length = along.norm();
  const Point back = b.to - b.from;
  if (along.dot(back) >= 0.0) return std::nullopt;
  const auto place = [&](const Point& p) { return (p - a.from).dot(along) / (length * length); };
  const auto distance = [&](const Point& p) { return cross(along, p - a.from) / length; };

  // b runs backwards: its end comes first along a.
  const double b_begin = place(b.to);
  const double b_end = place(b.from);
  const double begin = std::max(0.0, b_begin);
  const double end = std::min(1.0, b_end);
  if ((end - begin) * length < tolerance) return std::nullopt;
  const auto on_b = [&](double s) { return (b_end - s) / (b_end - b_begin); };  // weight of b.to
  for (const double s : {begin, end})
    if (std::abs(distance(b.from + on_b(s) * back)) > tolerance) return std::nullopt;
  return Joint{.first = a.block,
               .second = b.block,
               .first_edge = a.edge,
               .second_edge = b.edge,
               .first_at = {begin, end},
               .second_at = {on_b(begin), on_b(end)},
               .length = (end - begin) * length};
}

}  // namespace

std::vector<Joint> find_joints(const Mesh& mesh, double tolerance) {
  const std::vector<PlacedEdge> edges = edges_by_left_end(mesh);
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && edges[j].left() <= edges[i].right() + tolerance; ++j) {
      if (edges[i].block == edges[j].block) continue;
      const bool in_order = edges[i].block < edges[j].block;
      const auto stretch = in_order ? facing_stretch(edges[i], edges[j], tolerance)
                                    : facing_stretch(edges[j], edges[i], tolerance);
      if (stretch) joints.push_back(*stretch);
    }
  std::stable_sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return joints;
}

}  // namespace voussoir
