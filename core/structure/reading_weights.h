#pragma once
/// @file What a sensor reads, as a weighted sum of the displacements of the nodes about it, so that a new
/// sensor needs no new solution.

#include <vector>

#include "core/structure/mesh.h"

namespace voussoir {

/// A displacement of this node counts this much in each direction.
struct NodeWeight {
  NodeId node;
  Point weight;
};

/// A place of the bridge and the block that it belongs to.
struct Place {
  Point position;  ///< [m]
  BlockId block;
};

/// Weights by which the displacement of a place in a direction follows from the nodes of the triangle about
/// it (linear shape functions).
std::vector<NodeWeight> displacement_weights(const Place& place, const Point& direction, const Mesh& mesh);

/// Rotation of a block: least squares over its nodes, all counting the same.
std::vector<NodeWeight> rotation_weights(BlockId block, const Mesh& mesh);

/// Change of the distance of two places, first order. Precondition: they are not one place.
std::vector<NodeWeight> distance_weights(const Place& from, const Place& to, const Mesh& mesh);

/// The weighted sum [m or rad]; NaN if one of the nodes has no displacement.
double weighted_sum(const std::vector<NodeWeight>& weights, const Field& field);

}  // namespace voussoir
