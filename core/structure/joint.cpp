#include "core/structure/joint.h"

#include <algorithm>
#include <optional>

#include "core/geometry/facing_edges.h"

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

std::optional<Joint> joint_between(const PlacedEdge& a, const PlacedEdge& b, double tolerance) {
  const auto stretch = facing_stretch({a.from, a.to}, {b.from, b.to}, tolerance);
  if (!stretch) return std::nullopt;
  return Joint{.first = a.block,
               .second = b.block,
               .first_edge = a.edge,
               .second_edge = b.edge,
               .first_at = stretch->on_first,
               .second_at = stretch->on_second,
               .length = stretch->length};
}

}  // namespace

std::array<Point, 2> ends_of(const Joint& joint, const Mesh& mesh) {
  const Point from = mesh.position(joint.first_edge.from);
  const Point along = mesh.position(joint.first_edge.to) - from;
  return {from + joint.first_at[0] * along, from + joint.first_at[1] * along};
}

Point middle_of(const Joint& joint, const Mesh& mesh) {
  const auto [first, last] = ends_of(joint, mesh);
  return 0.5 * (first + last);
}

std::vector<Joint> find_joints(const Mesh& mesh, double tolerance) {
  const std::vector<PlacedEdge> edges = edges_by_left_end(mesh);
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && edges[j].left() <= edges[i].right() + tolerance; ++j) {
      if (edges[i].block == edges[j].block) continue;
      const bool in_order = edges[i].block < edges[j].block;
      const auto stretch = in_order ? joint_between(edges[i], edges[j], tolerance)
                                    : joint_between(edges[j], edges[i], tolerance);
      if (stretch) joints.push_back(*stretch);
    }
  std::stable_sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return joints;
}

}  // namespace voussoir
