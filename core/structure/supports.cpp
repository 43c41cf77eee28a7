#include "core/structure/supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

/// The nodes whose coordinate along an axis has this value.
std::vector<NodeId> nodes_at(const Mesh& mesh, int axis, double coordinate, double tolerance) {
  std::vector<NodeId> nodes;
  for (int node = 0; node < mesh.node_count(); ++node)
    if (std::abs(mesh.nodes(axis, node) - coordinate) <= tolerance) nodes.push_back(NodeId{node});
  return nodes;
}

/// Where blocks stand on the ground side by side, from left to right [m].
std::vector<std::pair<double, double>> stretches_on_ground(const Mesh& mesh, double ground,
                                                           double tolerance) {
  std::vector<std::pair<double, double>> edges;
  for (const BoundaryEdge& edge : mesh.edges) {
    const Point from = mesh.position(edge.from);
    const Point to = mesh.position(edge.to);
    if (std::abs(from.y() - ground) <= tolerance && std::abs(to.y() - ground) <= tolerance)
      edges.emplace_back(std::minmax(from.x(), to.x()));
  }
  std::ranges::sort(edges);
  std::vector<std::pair<double, double>> stretches;
  for (const auto& [left, right] : edges)
    if (stretches.empty() || left > stretches.back().second + tolerance)
      stretches.emplace_back(left, right);
    else
      stretches.back().second = std::max(stretches.back().second, right);
  return stretches;
}

/// `normal_axis`: 0 for a vertical face, 1 for a horizontal one.
Support face(const std::string& name, std::vector<NodeId> nodes, SupportKind kind, int normal_axis) {
  const auto holds = [&](int axis) {
    return kind == SupportKind::clamped || (kind == SupportKind::roller && axis == normal_axis);
  };
  return {name, std::move(nodes), holds(0), holds(1), false};
}

/// How far x is from a stretch [m]; 0 on it.
double distance(double x, const std::pair<double, double>& stretch) {
  return std::max({0.0, stretch.first - x, x - stretch.second});
}

std::size_t nearest(double x, const std::vector<std::pair<double, double>>& stretches) {
  std::size_t found = 0;
  for (std::size_t i = 1; i < stretches.size(); ++i)
    if (distance(x, stretches[i]) < distance(x, stretches[found])) found = i;
  return found;
}

/// Ground nodes that touch no ground edge (a corner on the ground) are the nearest foot's.
std::vector<Support> feet(const Mesh& mesh, SupportKind kind, double ground, double tolerance) {
  const auto stretches = stretches_on_ground(mesh, ground, tolerance);
  std::vector<Support> supports;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    supports.push_back(face(fmt::format("foot {}", i + 1), {}, kind, 1));
    supports.back().is_foot = true;
  }
  if (supports.empty()) return {face("base", nodes_at(mesh, 1, ground, tolerance), kind, 1)};
  for (const NodeId node : nodes_at(mesh, 1, ground, tolerance))
    supports[nearest(mesh.position(node).x(), stretches)].nodes.push_back(node);
  return supports;
}

/// Adds the nodes of the blocks in these courses that are not yet there, each block's to the support that
/// `support_of` names.
template <class SupportOf>
void embed(const BlockLayout& layout, const Mesh& mesh, int first_course, int last_course,
           const SupportOf& support_of) {
  for (std::size_t b = 0; b < layout.size(); ++b) {
    const int course = layout.blocks[b].index.course;
    if (course < std::max(first_course, 1) || course > last_course) continue;
    Support& support = support_of(layout.blocks[b]);
    for (int node = mesh.block_nodes[b].begin; node < mesh.block_nodes[b].end; ++node)
      if (std::ranges::find(support.nodes, NodeId{node}) == support.nodes.end())
        support.nodes.push_back(NodeId{node});
  }
}

/// Each block of the lowest courses in the foot below it, or in the nearest one.
void embed_in_feet(const BlockLayout& layout, const Mesh& mesh, int courses, std::vector<Support>& supports) {
  std::vector<std::size_t> feet;
  std::vector<std::pair<double, double>> stretches;
  for (std::size_t s = 0; s < supports.size(); ++s) {
    if (!supports[s].is_foot) continue;
    const auto [left, right] =
        std::ranges::minmax(supports[s].nodes, {}, [&](NodeId node) { return mesh.position(node).x(); });
    feet.push_back(s);
    stretches.emplace_back(mesh.position(left).x(), mesh.position(right).x());
  }
  if (feet.empty()) return;
  embed(layout, mesh, 1, courses, [&](const Block& block) -> Support& {
    return supports[feet[nearest(centroid(block.polygon).x(), stretches)]];
  });
}

void hold_top(const BridgeDescription& description, const BlockLayout& layout, const Mesh& mesh,
              std::vector<Support>& supports) {
  const WallDescription& wall = description.wall;
  const SupportDescription& held = description.supports;
  const double height = wall.courses * wall.course_height;
  if (held.top == SupportKind::free || wall.courses == 0) return;
  supports.push_back(face("top", nodes_at(mesh, 1, height, 1e-9 * height), held.top, 1));
  embed(layout, mesh, wall.courses - held.embedded_courses + 1, wall.courses,
        [&](const Block&) -> Support& { return supports.back(); });
}

}  // namespace

std::vector<Support> box_supports(const Mesh& mesh, const SupportDescription& description, double length,
                                  const Point& corner) {
  const double tolerance = 1e-9 * length;
  std::vector<Support> supports = feet(mesh, description.base, corner.y(), tolerance);
  supports.push_back(face("left side", nodes_at(mesh, 0, corner.x(), tolerance), description.sides, 0));
  supports.push_back(
      face("right side", nodes_at(mesh, 0, corner.x() + length, tolerance), description.sides, 0));
  std::erase_if(supports, [](const Support& s) { return s.nodes.empty() || !(s.holds_x || s.holds_y); });
  return supports;
}

std::vector<Support> supports_of(const BridgeDescription& description, const BlockLayout& layout,
                                 const Mesh& mesh) {
  const Bounds bounds = bounds_of(description);
  std::vector<Support> supports = box_supports(mesh, description.supports, bounds.length, bounds.corner);
  if (!description.blocks.empty()) return supports;  // they have no courses
  embed_in_feet(layout, mesh, description.supports.embedded_courses, supports);
  hold_top(description, layout, mesh, supports);
  return supports;
}

bool goes_with(const std::vector<Support>& supports, std::size_t support, NodeId node, int axis) {
  const auto holds = [axis](const Support& one) { return axis == 0 ? one.holds_x : one.holds_y; };
  return holds(supports[support]) &&
         std::none_of(supports.begin(), supports.begin() + static_cast<std::ptrdiff_t>(support),
                      [&](const Support& earlier) {
                        return holds(earlier) &&
                               std::ranges::find(earlier.nodes, node) != earlier.nodes.end();
                      });
}

std::vector<bool> held_components(const std::vector<Support>& supports, const Mesh& mesh) {
  std::vector<bool> held(static_cast<std::size_t>(2 * mesh.node_count()), false);
  for (const Support& support : supports)
    for (const NodeId node : support.nodes) {
      const auto x = static_cast<std::size_t>(2 * value(node));
      held[x] = held[x] || support.holds_x;
      held[x + 1] = held[x + 1] || support.holds_y;
    }
  return held;
}

}  // namespace voussoir
