#include "database/records/schema.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "database/format/names.h"
#include "database/records/stored_sensitivities.h"

namespace voussoir {
namespace {

Bytes bytes_of(ByteView view) {
  return {view.begin(), view.end()};
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
  std::vector<std::string> labels;
  std::vector<std::uint8_t> role;
  std::vector<std::int32_t> ring;
  std::vector<std::int32_t> index;
  std::vector<std::uint8_t> kind;
  std::vector<std::uint8_t> top;
  std::vector<Point> corners;
  std::vector<IndexRange> ranges;
  for (const Block& block : layout.blocks) {
    labels.push_back(block.label);
    role.push_back(static_cast<std::uint8_t>(block.role));
    ring.push_back(block.ring);
    index.insert(index.end(), {block.index.course, block.index.position});
    kind.push_back(static_cast<std::uint8_t>(block.kind));
    top.push_back(block.top_course ? 1 : 0);
    const int begin = static_cast<int>(corners.size());
    corners.insert(corners.end(), block.polygon.begin(), block.polygon.end());
    ranges.push_back({begin, static_cast<int>(corners.size())});
  }
  datasets.push_back(
      name_dataset(dataset::kBlockLabel, labels, kBlockLabelWidth, "what each block is called"));
  datasets.push_back(flag_dataset(dataset::kBlockRole, role,
                                  "0 wall, 1 arch ring, 2 pier, 3 abutment, 4 parapet, 5 backing, 6 fill"));
  datasets.push_back(int_dataset(dataset::kBlockRing, ring, kFlat, "ring that each block belongs to, or -1"));
  datasets.push_back(int_dataset(dataset::kBlockIndex, index, 2,
                                 "course (0: arch, -1: not laid in courses) and position of each block"));
  datasets.push_back(flag_dataset(dataset::kBlockKind, kind, "0 leg, 1 voussoir, 2 plain, 3 any other"));
  datasets.push_back(flag_dataset(dataset::kBlockTopCourse, top, "1: belongs to the highest course"));
  datasets.push_back(point_dataset(dataset::kCorners, corners,
                                   "x, y of the blocks' corners, counter-clockwise, block after block"));
  datasets.push_back(
      range_dataset(dataset::kBlockCorners, ranges, "first and one past the last corner of each block"));
}

void append_mesh(const Mesh& mesh, std::vector<DatasetValue>& datasets) {
  std::vector<Point> nodes;
  for (int node = 0; node < mesh.node_count(); ++node) nodes.push_back(mesh.position(NodeId{node}));
  std::vector<std::int32_t> triangles;
  for (const Triangle& triangle : mesh.triangles)
    for (const NodeId node : triangle.nodes) triangles.push_back(value(node));
  std::vector<std::int32_t> edges;
  for (const BoundaryEdge& edge : mesh.edges) edges.insert(edges.end(), {value(edge.from), value(edge.to)});
  datasets.push_back(
      point_dataset(dataset::kNodes, nodes, "x, y of the nodes before loading, block after block"));
  datasets.push_back(range_dataset(dataset::kBlockNodes, mesh.block_nodes,
                                   "first and one past the last node of each block"));
  datasets.push_back(
      int_dataset(dataset::kTriangles, triangles, 3, "nodes of each triangle, counter-clockwise"));
  datasets.push_back(range_dataset(dataset::kBlockTriangles, mesh.block_triangles,
                                   "first and one past the last triangle of each block"));
  datasets.push_back(int_dataset(dataset::kEdges, edges, 2,
                                 "from-node and to-node of each boundary edge, the block on its left"));
  datasets.push_back(range_dataset(dataset::kBlockEdges, mesh.block_edges,
                                   "first and one past the last edge of each block"));
}

void append_joints(const std::vector<Joint>& joints, std::vector<DatasetValue>& datasets) {
  if (joints.empty()) return;
  std::vector<std::int32_t> blocks;
  std::vector<std::int32_t> nodes;
  std::vector<double> ends;
  std::vector<double> lengths;
  for (const Joint& joint : joints) {
    blocks.insert(blocks.end(), {value(joint.first), value(joint.second)});
    for (const BoundaryEdge& edge : {joint.first_edge, joint.second_edge})
      nodes.insert(nodes.end(), {value(edge.from), value(edge.to)});
    for (const auto& at : {joint.first_at, joint.second_at}) ends.insert(ends.end(), at.begin(), at.end());
    lengths.push_back(joint.length);
  }
  datasets.push_back(int_dataset(dataset::kJointBlocks, blocks, 2,
                                 "first and second block of each joint, its normal pointing to the second"));
  datasets.push_back(
      int_dataset(dataset::kJointNodes, nodes, 4,
                  "from- and to-node of the joint's edge of the first block, then of the second"));
  datasets.push_back(
      dataset_of(dataset::kJointEnds, ElementType::float64, ends, 4, "1",
                 "ends of the joint on the edge of the first block, then the same two on that of "
                 "the second: 0 at the from-node, 1 at the to-node"));
  datasets.push_back(
      dataset_of(dataset::kJointLength, ElementType::float64, lengths, kFlat, "m", "length of each joint"));
}

/// Whether a point reads how far its node goes up.
bool is_plain(const ControlPoint& point) {
  return point.weights.empty();
}

void append_weights(const std::vector<ControlPoint>& points, std::vector<DatasetValue>& datasets) {
  std::vector<std::uint8_t> quantities;
  std::vector<std::int32_t> others, of_point, nodes;
  std::vector<double> weights;
  for (std::size_t i = 0; i < points.size(); ++i) {
    quantities.push_back(static_cast<std::uint8_t>(points[i].quantity));
    others.push_back(points[i].other_block ? value(*points[i].other_block) : kNoBlock);
    for (const NodeWeight& part : points[i].weights) {
      of_point.push_back(static_cast<std::int32_t>(i));
      nodes.push_back(value(part.node));
      weights.insert(weights.end(), {part.weight.x(), part.weight.y()});
    }
  }
  datasets.push_back(flag_dataset(dataset::kPointQuantity, quantities,
                                  "what each point reads: 0 u_x, 1 u_y, 2 tilt [rad, counter-clockwise], 3 "
                                  "how much longer a distance becomes"));
  datasets.push_back(int_dataset(dataset::kPointOtherBlock, others, kFlat,
                                 "of a distance between two blocks the second one, else -1"));
  datasets.push_back(
      int_dataset(dataset::kWeightPoint, of_point, kFlat,
                  "point that each weight belongs to; those without any read u_y of their node"));
  datasets.push_back(int_dataset(dataset::kWeightNode, nodes, kFlat, "node that each weight is of"));
  datasets.push_back(
      dataset_of(dataset::kWeight, ElementType::float64, weights, 2, "1",
                 "how much u_x and u_y of the node count in what the point reads (tilts: 1/m)"));
}

void append_points(const std::vector<ControlPoint>& points, std::vector<DatasetValue>& datasets) {
  std::vector<std::string> names;
  std::vector<Point> positions;
  std::vector<std::int32_t> blocks;
  std::vector<std::int32_t> nodes;
  for (const ControlPoint& point : points) {
    names.push_back(point.name);
    positions.push_back(point.position);
    blocks.push_back(value(point.block));
    nodes.push_back(value(point.node));
  }
  datasets.push_back(name_dataset(dataset::kPointName, names, kPointNameWidth,
                                  "T1.. on top, A1.. on the intrados, from left to right"));
  datasets.push_back(
      point_dataset(dataset::kPointPosition, positions, "x, y of the control points before loading"));
  datasets.push_back(int_dataset(dataset::kPointBlock, blocks, kFlat, "block of each control point"));
  datasets.push_back(int_dataset(dataset::kPointNode, nodes, kFlat, "node at each control point"));
  if (!std::ranges::all_of(points, is_plain)) append_weights(points, datasets);
}

}  // namespace

DatasetValue text_dataset(const char* path, const std::string& text, const char* meaning) {
  DatasetValue value{path, ElementType::text, {}, std::max<std::size_t>(text.size(), 1), "text", meaning, {}};
  value.bytes = bytes_of(view_bytes(text));
  value.bytes.resize(value.text_width);  // an empty text is one zero
  return value;
}

std::vector<DatasetValue> shared_datasets(const Provenance& provenance, const Model& bridge,
                                          const std::vector<VariantParameters>& variants,
                                          const std::vector<std::string>& states,
                                          const std::vector<ModelError>& model_errors,
                                          const Sensitivities* sensitivities) {
  std::vector<DatasetValue> datasets;
  datasets.push_back(text_dataset(dataset::kBridgeText, provenance.bridge_text, kBridgeTextMeaning));
  datasets.push_back(text_dataset(dataset::kSolverSettings, provenance.solver_settings,
                                  "`key = value` lines: all settings that results depend on"));
  append_blocks(bridge.layout, datasets);
  append_mesh(bridge.mesh, datasets);
  append_joints(bridge.joints, datasets);
  append_points(bridge.control_points, datasets);
  datasets.push_back(name_dataset(dataset::kStates, states, kStateNameWidth,
                                  "the states of every record, in their order: a history, or a history, a "
                                  "colon and a stage of a load case"));
  std::ranges::move(model_error_datasets(model_errors, states.size(), bridge.control_points.size()),
                    std::back_inserter(datasets));
  if (sensitivities != nullptr)
    std::ranges::move(sensitivity_datasets(*sensitivities), std::back_inserter(datasets));
  std::ranges::move(parameter_datasets(variants), std::back_inserter(datasets));
  return datasets;
}

}  // namespace voussoir
