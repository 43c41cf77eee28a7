#include "core/structure/supports.h"

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

/// `normal_axis`: 0 for a vertical face, 1 for a horizontal one.
Support face(const char* name, std::vector<NodeId> nodes, SupportKind kind, int normal_axis) {
  const auto holds = [&](int axis) {
    return kind == SupportKind::clamped || (kind == SupportKind::roller && axis == normal_axis);
  };
  return {name, std::move(nodes), holds(0), holds(1)};
}

}  // namespace

std::vector<Support> box_supports(const Mesh& mesh, const SupportDescription& description, double length) {
  const double tolerance = 1e-9 * length;
  std::vector<Support> supports = {
      face("base", nodes_at(mesh, 1, 0.0, tolerance), description.base, 1),
      face("left side", nodes_at(mesh, 0, 0.0, tolerance), description.sides, 0),
      face("right side", nodes_at(mesh, 0, length, tolerance), description.sides, 0)};
  std::erase_if(supports, [](const Support& s) { return s.nodes.empty() || !(s.holds_x || s.holds_y); });
  return supports;
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
