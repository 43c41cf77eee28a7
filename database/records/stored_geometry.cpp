#include "database/records/stored_geometry.h"

#include <algorithm>
#include <cmath>

#include "database/format/names.h"
#include "database/records/schema.h"

namespace voussoir {
namespace {

constexpr int kLeastCorners = 3;  ///< that a block has at least, and so edges and nodes

std::span<const std::int32_t> read_ints(const Hdf5File& file, const char* path, std::uint64_t columns) {
  return file.numbers<std::int32_t>(path, ElementType::int32, columns);
}

std::span<const double> read_finite(const Hdf5File& file, const char* path, std::uint64_t columns) {
  const auto numbers = file.numbers<double>(path, ElementType::float64, columns);
  file.require(std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }),
               fmt::format("dataset '{}' holds a number that is not finite", path));
  return numbers;
}

std::span<const double> read_points(const Hdf5File& file, const char* path) {
  return read_finite(file, path, 2);
}

void require_size(const Hdf5File& file, const char* path, std::size_t size, std::size_t expected) {
  file.require(size == expected,
               fmt::format("dataset '{}' has {} entries where {} were expected", path, size, expected));
}

/// Half-open ranges that follow each other without gaps from 0 to `total`, one a block, each of at least
/// `least`.
std::vector<IndexRange> read_ranges(const Hdf5File& file, const char* path, std::size_t blocks,
                                    std::size_t total, int least) {
  const auto numbers = read_ints(file, path, 2);
  require_size(file, path, numbers.size() / 2, blocks);
  std::vector<IndexRange> ranges;
  std::int32_t end = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const IndexRange range{numbers[2 * i], numbers[2 * i + 1]};
    file.require(
        range.begin == end && range.end >= range.begin && static_cast<std::size_t>(range.end) <= total,
        fmt::format("dataset '{}' holds a range out of order in row {}", path, i));
    file.require(range.size() >= least,
                 fmt::format("dataset '{}' has a range of {} in row {}, expected {} or more", path,
                             range.size(), i, least));
    ranges.push_back(range);
    end = range.end;
  }
  require_size(file, path, static_cast<std::size_t>(end), total);
  return ranges;
}

/// Numbers that all name one of `count` things.
std::span<const std::int32_t> read_indices(const Hdf5File& file, const char* path, std::uint64_t columns,
                                           std::size_t count) {
  const auto indices = read_ints(file, path, columns);
  const bool inside = std::all_of(indices.begin(), indices.end(), [count](std::int32_t index) {
    return index >= 0 && static_cast<std::size_t>(index) < count;
  });
  file.require(inside,
               fmt::format("dataset '{}' names something that does not exist (0 to {} do)", path, count - 1));
  return indices;
}

/// What a block's triangles, edges and joints hang on are its own nodes.
void require_own_nodes(const Hdf5File& file, const char* path, std::span<const std::int32_t> nodes,
                       std::size_t row, const IndexRange& own) {
  for (const std::int32_t node : nodes)
    file.require(own.contains(node),
                 fmt::format("dataset '{}' names node {} in row {}, expected one of its block's ({} to {})",
                             path, node, row, own.begin, own.end - 1));
}

/// The same for all blocks: rows of so many nodes, a range of rows for each block.
void require_own_nodes(const Hdf5File& file, const char* path, std::span<const std::int32_t> nodes,
                       std::size_t columns, const std::vector<IndexRange>& rows,
                       const std::vector<IndexRange>& own) {
  for (std::size_t block = 0; block < rows.size(); ++block)
    for (auto row = static_cast<std::size_t>(rows[block].begin);
         row < static_cast<std::size_t>(rows[block].end); ++row)
      require_own_nodes(file, path, nodes.subspan(columns * row, columns), row, own[block]);
}

/// The edges of a block go round it, each from where the one before ends.
void require_rounds(const Hdf5File& file, const Mesh& mesh) {
  for (const IndexRange& range : mesh.block_edges)
    for (int edge = range.begin; edge < range.end; ++edge) {
      const int next = edge + 1 < range.end ? edge + 1 : range.begin;
      file.require(
          mesh.edges[static_cast<std::size_t>(edge)].to == mesh.edges[static_cast<std::size_t>(next)].from,
          fmt::format(
              "dataset '{}': row {} does not begin where row {} ends, expected edges round each block",
              dataset::kEdges, next, edge));
    }
}

/// The to-node of the edge that begins at each node, -1 where none does.
std::vector<std::int32_t> ends_of_edges(const Mesh& mesh) {
  std::vector<std::int32_t> ends(static_cast<std::size_t>(mesh.node_count()), -1);
  for (const BoundaryEdge& edge : mesh.edges) ends[static_cast<std::size_t>(edge.from)] = value(edge.to);
  return ends;
}

/// A joint is between two blocks, of an edge of each.
void require_joint(const Hdf5File& file, const Mesh& mesh, std::span<const std::int32_t> edge_ends,
                   std::span<const std::int32_t> blocks, std::span<const std::int32_t> nodes,
                   std::size_t row) {
  file.require(blocks[0] < blocks[1],
               fmt::format("dataset '{}' has the blocks {} and {} in row {}, expected two in ascending order",
                           dataset::kJointBlocks, blocks[0], blocks[1], row));
  for (std::size_t side = 0; side < 2; ++side) {
    const auto edge = nodes.subspan(2 * side, 2);
    require_own_nodes(file, dataset::kJointNodes, edge, row,
                      mesh.block_nodes[static_cast<std::size_t>(blocks[side])]);
    file.require(
        edge_ends[static_cast<std::size_t>(edge[0])] == edge[1],
        fmt::format("dataset '{}' has the nodes {} and {} in row {}, expected those of a boundary edge",
                    dataset::kJointNodes, edge[0], edge[1], row));
  }
}

std::span<const std::uint8_t> read_flags(const Hdf5File& file, const char* path, std::size_t size,
                                         std::uint8_t highest) {
  const auto flags = file.numbers<std::uint8_t>(path, ElementType::uint8, kFlat);
  require_size(file, path, flags.size(), size);
  file.require(
      std::all_of(flags.begin(), flags.end(), [highest](std::uint8_t flag) { return flag <= highest; }),
      fmt::format("dataset '{}' holds a value above {}", path, highest));
  return flags;
}

bool is_node_of(BlockId block, std::int32_t node, const Mesh& mesh) {
  return mesh.block_nodes.at(static_cast<std::size_t>(value(block))).contains(node);
}

void read_quantities(const Hdf5File& file, std::vector<StoredPoint>& points) {
  const auto quantities =
      read_flags(file, dataset::kPointQuantity, points.size(), static_cast<std::uint8_t>(Quantity::distance));
  const auto others = read_ints(file, dataset::kPointOtherBlock, kFlat);
  require_size(file, dataset::kPointOtherBlock, others.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].quantity = static_cast<Quantity>(quantities[i]);
    if (others[i] != kNoBlock) points[i].other_block = BlockId{others[i]};
  }
}

}  // namespace

BlockLayout read_layout(const Hdf5File& file) {
  const auto index = read_ints(file, dataset::kBlockIndex, 2);
  const std::size_t blocks = index.size() / 2;
  const auto labels = read_names(file, dataset::kBlockLabel, kBlockLabelWidth);
  const auto role = read_flags(file, dataset::kBlockRole, blocks, kRoleNames.size() - 1);
  const auto ring = read_ints(file, dataset::kBlockRing, kFlat);
  require_size(file, dataset::kBlockLabel, labels.size(), blocks);
  require_size(file, dataset::kBlockRing, ring.size(), blocks);
  const auto kind = read_flags(file, dataset::kBlockKind, blocks, static_cast<std::uint8_t>(BlockKind::cut));
  const auto top = read_flags(file, dataset::kBlockTopCourse, blocks, 1);
  const auto corners = read_points(file, dataset::kCorners);
  const auto ranges = read_ranges(file, dataset::kBlockCorners, blocks, corners.size() / 2, kLeastCorners);
  BlockLayout layout;
  for (std::size_t i = 0; i < blocks; ++i) {
    Block block;
    block.index = {index[2 * i], index[2 * i + 1]};
    block.kind = static_cast<BlockKind>(kind[i]);
    block.top_course = top[i] != 0;
    block.label = labels[i];
    block.role = static_cast<BlockRole>(role[i]);
    block.ring = ring[i];
    for (auto corner = static_cast<std::size_t>(ranges[i].begin);
         corner < static_cast<std::size_t>(ranges[i].end); ++corner)
      block.polygon.emplace_back(corners[2 * corner], corners[2 * corner + 1]);
    layout.blocks.push_back(std::move(block));
  }
  return layout;
}

Mesh read_mesh(const Hdf5File& file, std::size_t blocks) {
  Mesh mesh;
  const auto nodes = read_points(file, dataset::kNodes);
  const std::size_t node_count = nodes.size() / 2;
  mesh.nodes = Eigen::Map<const Eigen::Matrix2Xd>(nodes.data(), 2, static_cast<Eigen::Index>(node_count));
  const auto triangles = read_ints(file, dataset::kTriangles, 3);
  const auto edges = read_ints(file, dataset::kEdges, 2);
  mesh.block_nodes = read_ranges(file, dataset::kBlockNodes, blocks, node_count, kLeastCorners);
  mesh.block_triangles = read_ranges(file, dataset::kBlockTriangles, blocks, triangles.size() / 3, 1);
  mesh.block_edges = read_ranges(file, dataset::kBlockEdges, blocks, edges.size() / 2, kLeastCorners);
  require_own_nodes(file, dataset::kTriangles, triangles, 3, mesh.block_triangles, mesh.block_nodes);
  require_own_nodes(file, dataset::kEdges, edges, 2, mesh.block_edges, mesh.block_nodes);
  for (std::size_t i = 0; i < triangles.size(); i += 3)
    mesh.triangles.push_back({{NodeId{triangles[i]}, NodeId{triangles[i + 1]}, NodeId{triangles[i + 2]}}});
  for (std::size_t i = 0; i < edges.size(); i += 2)
    mesh.edges.push_back({NodeId{edges[i]}, NodeId{edges[i + 1]}});
  require_rounds(file, mesh);
  return mesh;
}

std::vector<Joint> read_joints(const Hdf5File& file, const Mesh& mesh) {
  std::vector<Joint> joints;
  if (!file.has(dataset::kJointBlocks)) return joints;
  const auto blocks = read_indices(file, dataset::kJointBlocks, 2, mesh.block_nodes.size());
  const auto nodes = read_ints(file, dataset::kJointNodes, 4);
  const auto ends = read_finite(file, dataset::kJointEnds, 4);
  const auto lengths = read_finite(file, dataset::kJointLength, kFlat);
  require_size(file, dataset::kJointNodes, nodes.size() / 4, blocks.size() / 2);
  require_size(file, dataset::kJointEnds, ends.size() / 4, blocks.size() / 2);
  require_size(file, dataset::kJointLength, lengths.size(), blocks.size() / 2);
  const std::vector<std::int32_t> edge_ends = ends_of_edges(mesh);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto block = blocks.subspan(2 * i, 2);
    const auto node = nodes.subspan(4 * i, 4);
    const auto at = ends.subspan(4 * i, 4);
    require_joint(file, mesh, edge_ends, block, node, i);
    joints.push_back({BlockId{block[0]},
                      BlockId{block[1]},
                      {NodeId{node[0]}, NodeId{node[1]}},
                      {NodeId{node[2]}, NodeId{node[3]}},
                      {at[0], at[1]},
                      {at[2], at[3]},
                      lengths[i]});
  }
  return joints;
}

std::vector<std::string> read_states(const Hdf5File& file) {
  return read_names(file, dataset::kStates, kStateNameWidth);
}

std::vector<StoredPoint> read_control_points(const Hdf5File& file) {
  const auto names = read_names(file, dataset::kPointName, kPointNameWidth);
  const auto positions = read_points(file, dataset::kPointPosition);
  const auto blocks = read_ints(file, dataset::kPointBlock, kFlat);
  require_size(file, dataset::kPointPosition, positions.size() / 2, names.size());
  require_size(file, dataset::kPointBlock, blocks.size(), names.size());
  std::vector<StoredPoint> points;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    points.push_back({names[i], {positions[2 * i], positions[2 * i + 1]}, BlockId{blocks[i]}});
  if (file.has(dataset::kPointQuantity)) read_quantities(file, points);
  return points;
}

std::vector<std::vector<NodeWeight>> read_weights(const Hdf5File& file,
                                                  const std::vector<StoredPoint>& points, const Mesh& mesh) {
  std::vector<std::vector<NodeWeight>> weights(points.size());
  if (!file.has(dataset::kPointQuantity)) return weights;
  const auto of_point = read_indices(file, dataset::kWeightPoint, kFlat, points.size());
  const auto nodes =
      read_indices(file, dataset::kWeightNode, kFlat, static_cast<std::size_t>(mesh.node_count()));
  const auto numbers = read_points(file, dataset::kWeight);
  require_size(file, dataset::kWeightNode, nodes.size(), of_point.size());
  require_size(file, dataset::kWeight, numbers.size() / 2, of_point.size());
  for (std::size_t i = 0; i < of_point.size(); ++i) {
    const auto place = static_cast<std::size_t>(of_point[i]);
    const StoredPoint& point = points[place];
    file.require(is_node_of(point.block, nodes[i], mesh) ||
                     (point.other_block && is_node_of(*point.other_block, nodes[i], mesh)),
                 fmt::format("dataset '{}' has node {} in row {}, expected one of a block of sensor {}",
                             dataset::kWeightNode, nodes[i], i, point.name));
    weights[place].push_back({NodeId{nodes[i]}, {numbers[2 * i], numbers[2 * i + 1]}});
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    file.require(points[i].quantity == Quantity::uy || !weights[i].empty(),
                 fmt::format("dataset '{}' has no weights of sensor {}", dataset::kWeight, points[i].name));
  return weights;
}

}  // namespace voussoir
