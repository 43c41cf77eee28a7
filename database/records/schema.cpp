#include "database/records/schema.h"

#include <algorithm>

namespace voussoir {
namespace {

using Shape = std::vector<std::uint64_t>;

Bytes bytes_of(ByteView view) {
  return {view.begin(), view.end()};
}

DatasetValue text_dataset(const char* path, const std::string& text, const char* meaning) {
  DatasetValue value{path, ElementType::text, {}, std::max<std::size_t>(text.size(), 1), "text", meaning, {}};
  value.bytes = bytes_of(view_bytes(text));
  value.bytes.resize(value.text_width);  // an empty text is one zero
  return value;
}

DatasetValue int_dataset(const char* path, const std::vector<std::int32_t>& values, std::uint64_t columns,
                         const char* meaning) {
  return dataset_of(path, ElementType::int32, values, columns, "1", meaning);
}

DatasetValue flag_dataset(const char* path, const std::vector<std::uint8_t>& values, const char* meaning) {
  return dataset_of(path, ElementType::uint8, values, kFlat, "1", meaning);
}

DatasetValue point_dataset(const char* path, const std::vector<Point>& points, const char* meaning) {
  std::vector<double> values;
  for (const Point& point : points) values.insert(values.end(), {point.x(), point.y()});
  return dataset_of(path, ElementType::float64, values, 2, "m", meaning);
}

DatasetValue range_dataset(const char* path, const std::vector<IndexRange>& ranges, const char* meaning) {
  std::vector<std::int32_t> values;
  for (const IndexRange& range : ranges) values.insert(values.end(), {range.begin, range.end});
  return int_dataset(path, values, 2, meaning);
}

void append_blocks(const BlockLayout& layout, std::vector<DatasetValue>& datasets) {
  std::vector<std::int32_t> index;
  std::vector<std::uint8_t> kind;
  std::vector<std::uint8_t> top;
  std::vector<Point> corners;
  std::vector<IndexRange> ranges;
  for (const Block& block : layout.blocks) {
    index.insert(index.end(), {block.index.course, block.index.position});
    kind.push_back(static_cast<std::uint8_t>(block.kind));
    top.push_back(block.top_course ? 1 : 0);
    const int begin = static_cast<int>(corners.size());
    corners.insert(corners.end(), block.polygon.begin(), block.polygon.end());
    ranges.push_back({begin, static_cast<int>(corners.size())});
  }
  datasets.push_back(
      int_dataset(dataset::kBlockIndex, index, 2, "course (0 is the arch) and position of each block"));
  datasets.push_back(
      flag_dataset(dataset::kBlockKind, kind, "0 leg, 1 voussoir, 2 plain, 3 cut by the arch"));
  datasets.push_back(flag_dataset(dataset::kBlockTopCourse, top, "1 for blocks of the highest course"));
  datasets.push_back(
      point_dataset(dataset::kCorners, corners, "x, y of the blocks' corners, counter-clockwise"));
  datasets.push_back(
      range_dataset(dataset::kBlockCorners, ranges, "first and one past last corner of each block"));
}

void append_mesh(const Mesh& mesh, std::vector<DatasetValue>& datasets) {
  std::vector<Point> nodes;
  for (int node = 0; node < mesh.node_count(); ++node) nodes.push_back(mesh.position(NodeId{node}));
  std::vector<std::int32_t> triangles;
  for (const Triangle& triangle : mesh.triangles)
    for (const NodeId node : triangle.nodes) triangles.push_back(value(node));
  std::vector<std::int32_t> edges;
  for (const BoundaryEdge& edge : mesh.edges) edges.insert(edges.end(), {value(edge.from), value(edge.to)});
  datasets.push_back(point_dataset(dataset::kNodes, nodes, "x, y of the nodes before loading"));
  datasets.push_back(
      range_dataset(dataset::kBlockNodes, mesh.block_nodes, "first and one past last node of each block"));
  datasets.push_back(
      int_dataset(dataset::kTriangles, triangles, 3, "nodes of the triangles, counter-clockwise"));
  datasets.push_back(range_dataset(dataset::kBlockTriangles, mesh.block_triangles,
                                   "first and one past last triangle of each block"));
  datasets.push_back(
      int_dataset(dataset::kEdges, edges, 2, "nodes of the boundary edges, the block on the left"));
  datasets.push_back(
      range_dataset(dataset::kBlockEdges, mesh.block_edges, "first and one past last edge of each block"));
}

void append_points(const std::vector<ControlPoint>& points, std::vector<DatasetValue>& datasets) {
  DatasetValue names{dataset::kPointName,
                     ElementType::text,
                     {points.size()},
                     kPointNameWidth,
                     "text",
                     "T: on top, A: on the intrados, from left to right",
                     {}};
  std::vector<Point> positions;
  std::vector<std::int32_t> blocks;
  std::vector<std::int32_t> nodes;
  for (const ControlPoint& point : points) {
    std::string name = point.name;
    name.resize(kPointNameWidth);
    const ByteView bytes = view_bytes(name);
    names.bytes.insert(names.bytes.end(), bytes.begin(), bytes.end());
    positions.push_back(point.position);
    blocks.push_back(value(point.block));
    nodes.push_back(value(point.node));
  }
  datasets.push_back(std::move(names));
  datasets.push_back(
      point_dataset(dataset::kPointPosition, positions, "x, y of the control points before loading"));
  datasets.push_back(
      int_dataset(dataset::kPointBlock, blocks, kFlat, "block that each control point belongs to"));
  datasets.push_back(int_dataset(dataset::kPointNode, nodes, kFlat, "node at each control point"));
}

}  // namespace

std::vector<DatasetValue> shared_datasets(const Provenance& provenance, const BlockLayout& layout,
                                          const Mesh& mesh, const std::vector<ControlPoint>& points) {
  std::vector<DatasetValue> datasets;
  datasets.push_back(text_dataset(dataset::kBridgeText, provenance.bridge_text, "the bridge file (TOML)"));
  datasets.push_back(text_dataset(dataset::kSolverSettings, provenance.solver_settings, "key = value lines"));
  append_blocks(layout, datasets);
  append_mesh(mesh, datasets);
  append_points(points, datasets);
  return datasets;
}

}  // namespace voussoir
