#include "core/structure/patch.h"

#include <algorithm>
#include <iterator>

#include "core/structure/neighbours.h"

namespace voussoir {
namespace {

constexpr int kNowhere = -1;

struct Cut {
  std::vector<int> block;  ///< of each block of the bridge, that of the patch, or kNowhere
  std::vector<int> node;
};

template <class Id>
Id mapped(Id id, const std::vector<int>& places) {
  return Id{places[static_cast<std::size_t>(value(id))]};
}

/// Both ascending, with no block in both.
std::vector<BlockId> merged(const std::vector<BlockId>& some, const std::vector<BlockId>& others) {
  std::vector<BlockId> all;
  std::ranges::merge(some, others, std::back_inserter(all));
  return all;
}

void add_block(BlockId block, const Model& bridge, Patch& patch, Cut& cut) {
  const auto b = static_cast<std::size_t>(value(block));
  const Mesh& from = bridge.mesh;
  Mesh& to = patch.model.mesh;
  cut.block[b] = static_cast<int>(patch.blocks.size());
  patch.blocks.push_back(block);
  patch.model.layout.blocks.push_back(bridge.layout.blocks[b]);
  patch.model.parameters.blocks.push_back(bridge.parameters.blocks[b]);
  if (!bridge.parameters.contact_share.empty())
    patch.model.parameters.contact_share.push_back(bridge.parameters.contact_share[b]);
  const auto begin = static_cast<int>(patch.nodes.size());
  for (int n = from.block_nodes[b].begin; n < from.block_nodes[b].end; ++n) {
    cut.node[static_cast<std::size_t>(n)] = static_cast<int>(patch.nodes.size());
    patch.nodes.push_back(NodeId{n});
  }
  to.block_nodes.push_back({begin, static_cast<int>(patch.nodes.size())});
  const auto first_triangle = static_cast<int>(to.triangles.size());
  for (int t = from.block_triangles[b].begin; t < from.block_triangles[b].end; ++t) {
    Triangle triangle = from.triangles[static_cast<std::size_t>(t)];
    for (NodeId& node : triangle.nodes) node = mapped(node, cut.node);
    to.triangles.push_back(triangle);
  }
  to.block_triangles.push_back({first_triangle, static_cast<int>(to.triangles.size())});
  const auto first_edge = static_cast<int>(to.edges.size());
  for (int e = from.block_edges[b].begin; e < from.block_edges[b].end; ++e) {
    const BoundaryEdge& edge = from.edges[static_cast<std::size_t>(e)];
    to.edges.push_back({mapped(edge.from, cut.node), mapped(edge.to, cut.node)});
  }
  to.block_edges.push_back({first_edge, static_cast<int>(to.edges.size())});
}

void add_joints(const Model& bridge, const Cut& cut, Patch& patch) {
  for (std::size_t j = 0; j < bridge.joints.size(); ++j) {
    Joint joint = bridge.joints[j];
    joint.first = mapped(joint.first, cut.block);
    joint.second = mapped(joint.second, cut.block);
    if (value(joint.first) == kNowhere || value(joint.second) == kNowhere) continue;
    for (BoundaryEdge* edge : {&joint.first_edge, &joint.second_edge})
      *edge = {mapped(edge->from, cut.node), mapped(edge->to, cut.node)};
    patch.model.joints.push_back(joint);
    patch.model.parameters.joints.push_back(bridge.parameters.joints[j]);
  }
}

void add_supports(const Model& bridge, const Cut& cut, Patch& patch) {
  for (Support support : bridge.supports) {
    for (NodeId& node : support.nodes) node = mapped(node, cut.node);
    std::erase(support.nodes, NodeId{kNowhere});
    if (!support.nodes.empty()) patch.model.supports.push_back(std::move(support));
  }
  Support rim{.name = "rim", .nodes = {}, .holds_x = true, .holds_y = true};
  for (const BlockId block : patch.rim) {
    const IndexRange& range = patch.model.mesh.block_nodes[static_cast<std::size_t>(value(block))];
    for (int n = range.begin; n < range.end; ++n) rim.nodes.push_back(NodeId{n});
  }
  if (!rim.nodes.empty()) patch.model.supports.push_back(std::move(rim));
}

}  // namespace

Scene Patch::scene_of(const Scene& bridge) const {
  Scene result;
  for (const BlockId block : bridge.removed)
    if (const auto at = std::ranges::lower_bound(blocks, block); at != blocks.end() && *at == block)
      result.removed.push_back(BlockId{static_cast<int>(at - blocks.begin())});
  return result;
}

Field Patch::field_of(const Field& bridge) const {
  Field result(2, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n)
    result.col(static_cast<Eigen::Index>(n)) = bridge.col(value(nodes[n]));
  return result;
}

Patch patch_around(const Scene& scene, int neighbours, const Model& bridge) {
  Scene within = scene;
  for (int k = 0; k < neighbours; ++k) within.removed = merged(within.removed, blocks_beside(within, bridge));
  const std::vector<BlockId> rim = blocks_beside(within, bridge);
  Patch patch;
  patch.blocks_of_bridge = bridge.block_count();
  Cut cut{std::vector<int>(bridge.layout.size(), kNowhere),
          std::vector<int>(static_cast<std::size_t>(bridge.mesh.node_count()), kNowhere)};
  for (const BlockId block : merged(within.removed, rim)) add_block(block, bridge, patch, cut);
  for (const BlockId block : rim) patch.rim.push_back(mapped(block, cut.block));
  patch.model.mesh.nodes = patch.field_of(bridge.mesh.nodes);
  Parameters& parameters = patch.model.parameters;
  parameters.gravity = bridge.parameters.gravity;
  parameters.contact = bridge.parameters.contact;
  if (bridge.parameters.laid_mass.size() > 0) {
    parameters.laid_mass.resize(static_cast<Eigen::Index>(patch.nodes.size()));
    for (std::size_t n = 0; n < patch.nodes.size(); ++n)
      parameters.laid_mass[static_cast<Eigen::Index>(n)] = bridge.parameters.laid_mass[value(patch.nodes[n])];
  }
  add_joints(bridge, cut, patch);
  add_supports(bridge, cut, patch);
  return patch;
}

}  // namespace voussoir
