#include "core/structure/collapse.h"

#include <algorithm>

namespace voussoir {

std::string_view to_string(CollapseExtent extent) {
  switch (extent) {
    case CollapseExtent::local:
      return "local";
    case CollapseExtent::arch:
      return "arch";
    case CollapseExtent::none:
      break;
  }
  return "none";
}

CollapseExtent collapse_extent(const BlockLayout& layout, const std::vector<BlockId>& moving) {
  if (moving.empty()) return CollapseExtent::none;
  const bool ring =
      std::any_of(moving.begin(), moving.end(), [&](BlockId b) { return layout[b].role == BlockRole::ring; });
  return ring ? CollapseExtent::arch : CollapseExtent::local;
}

std::vector<BlockId> blocks_moved_beyond(double distance, const Mesh& mesh, const Field& displacement) {
  std::vector<BlockId> moved;
  for (std::size_t b = 0; b < mesh.block_nodes.size(); ++b) {
    const IndexRange& nodes = mesh.block_nodes[b];
    const auto ways = displacement.middleCols(nodes.begin, nodes.size()).colwise().norm();
    if ((ways.array() > distance).any()) moved.push_back(BlockId{static_cast<std::int32_t>(b)});
  }
  return moved;
}

}  // namespace voussoir
