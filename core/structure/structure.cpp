#include "core/structure/structure.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/structure/assembly_check.h"
#include "core/structure/gone_blocks.h"
#include "core/structure/halved_blocks.h"

namespace voussoir {
namespace {

void check_blocks(const std::vector<Block>& blocks) {
  std::set<std::string> labels;
  for (const Block& block : blocks) {
    if (!labels.insert(block.label).second)
      throw InputError(
          fmt::format("two blocks are called '{}': expected a label of its own for each block", block.label));
    if (block.polygon.size() < 3 || area(block.polygon) <= 0.0)
      throw InputError(
          fmt::format("block '{}': expected at least three corners, counter-clockwise", block.label));
  }
}

/// Every block has a node that a support holds, or meets others that do.
void check_carried(const Structure& structure) {
  std::vector<bool> held_nodes(static_cast<std::size_t>(structure.mesh.node_count()), false);
  for (const Support& support : structure.supports)
    for (const NodeId node : support.nodes) held_nodes[static_cast<std::size_t>(value(node))] = true;
  std::vector<bool> held;
  for (const IndexRange& nodes : structure.mesh.block_nodes)
    held.push_back(std::any_of(held_nodes.begin() + nodes.begin, held_nodes.begin() + nodes.end,
                               [](bool is_held) { return is_held; }));
  BlockPairs touching;
  for (const Joint& joint : structure.joints)
    touching.emplace_back(static_cast<std::size_t>(value(joint.first)),
                          static_cast<std::size_t>(value(joint.second)));
  const auto loose = first_loose(held, touching);
  if (!loose) return;
  const Block& block = structure.layout.blocks[*loose];
  const Point place = centroid(block.polygon);
  throw InputError(fmt::format(
      "block '{}' at ({:.4g}, {:.4g}) is loose: expected blocks that touch others, down to the supports{}",
      block.label, place.x(), place.y(),
      block.role == BlockRole::ring ? " (a ring stands on courses that reach above its springing, or on "
                                      "stones of its own: skewback_m in [[spans]])"
                                    : ""));
}

/// Something can move.
void expect_free(const Structure& structure) {
  const std::vector<bool> held = held_components(structure.supports, structure.mesh);
  if (std::ranges::find(held, false) == held.end())
    throw InputError("supports hold every corner of every block: expected a structure that can move");
}

}  // namespace

double mean_block_size(const Structure& structure) {
  double sum = 0.0;
  for (const Block& block : structure.layout.blocks) sum += std::sqrt(area(block.polygon));
  return sum / structure.block_count();
}

Structure assemble(std::vector<Block> blocks, const AssemblyRules& rules) {
  check_blocks(blocks);
  Structure structure;
  structure.layout.blocks = std::move(blocks);
  structure.mesh = make_mesh(structure.layout, rules.mesh, rules.mirror_axis);
  structure.joints = find_joints(structure.mesh, rules.joint_tolerance);
  structure.symmetry = find_mirror_symmetry(structure.layout, structure.mesh, rules.mirror_axis);
  return structure;
}

Structure make_structure(const BridgeDescription& description) {
  const Bounds bounds = bounds_of(description);
  BlockLayout laid = lay_blocks(description);
  std::vector<Block> blocks = halved(std::move(laid.blocks), description.wall);
  std::vector<GoneBlock> gone = take_out(description.missing_blocks, blocks);
  Structure structure = assemble(std::move(blocks), {.mesh = description.mesh,
                                                     .joint_tolerance = description.joint_tolerance,
                                                     .mirror_axis = bounds.corner.x() + 0.5 * bounds.length});
  structure.layout.small_pieces = laid.small_pieces;
  structure.layout.gone = std::move(gone);
  structure.supports = supports_of(description, structure.layout, structure.mesh);
  if (!structure.supports.empty()) check_carried(structure);
  expect_free(structure);
  structure.control_points = find_control_points(structure.layout, structure.mesh, description);
  if (structure.control_points.empty())
    throw InputError("the bridge has no control points: switch on top or arch");
  return structure;
}

}  // namespace voussoir
