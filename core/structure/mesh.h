#pragma once
/// @file Constant-strain triangles, own nodes per block.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/structure/block_layout.h"

namespace voussoir {

/// Column in Mesh::nodes and in every field.
enum class NodeId : std::int32_t {};

constexpr int value(NodeId id) {
  return static_cast<int>(id);
}

/// Displacements of all nodes [m], 2 x nodes; NaN at the nodes of removed blocks.
using Field = Eigen::Matrix2Xd;

/// Zero where the field says nothing.
inline Field without_nan(const Field& field) {
  return field.array().isNaN().select(0.0, field);
}

struct Triangle {
  std::array<NodeId, 3> nodes;  ///< counter-clockwise
};

/// A stretch of a block's boundary between two nodes, with the block on its left.
struct BoundaryEdge {
  NodeId from;
  NodeId to;
};

/// Half-open range of positions in a vector.
struct IndexRange {
  int begin = 0;
  int end = 0;
  int size() const { return end - begin; }
  bool contains(int index) const { return index >= begin && index < end; }
};

struct Mesh {
  Eigen::Matrix2Xd nodes;                   ///< reference positions [m], block after block
  std::vector<Triangle> triangles;          ///< block after block
  std::vector<BoundaryEdge> edges;          ///< block after block, counter-clockwise round each
  std::vector<IndexRange> block_nodes;      ///< per block: its columns in `nodes`
  std::vector<IndexRange> block_triangles;  ///< per block: its range in `triangles`
  std::vector<IndexRange> block_edges;      ///< per block: its range in `edges`

  int node_count() const { return static_cast<int>(nodes.cols()); }
  Point position(NodeId id) const { return nodes.col(value(id)); }
};

/// Shares of a triangle's corners in a place; none is negative within the triangle.
Eigen::Vector3d barycentric_coordinates(const Mesh& mesh, const Triangle& triangle, const Point& place);

/// Cuts the blocks into triangles: two to a plain block, three to a voussoir, four about the centre to a leg
/// and to a block of the top course, and as few as its corners allow to a block cut by the arch; a block
/// astride `mirror_axis` is fanned about its centre, or cut in two halves alike where the centre does not see
/// all corners, so that the mesh of a symmetric bridge is its own mirror image.
Mesh make_mesh(const BlockLayout& layout, const MeshDescription& rule, double mirror_axis);

}  // namespace voussoir
