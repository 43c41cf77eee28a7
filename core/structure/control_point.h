#pragma once
/// @file The points whose vertical displacement is measured (paper, Fig. 1), and the sensors that a bridge
/// file has besides.

#include <string>
#include <vector>

#include "core/structure/mesh.h"
#include "core/structure/reading_weights.h"
#include "core/structure/scene.h"

namespace voussoir {

/// A control point, or a sensor of the bridge file.
struct ControlPoint {
  std::string name;  ///< T1.. on top, A1.. on the intrados, F1.. on the face, or the sensor's own
  NodeId node;       ///< of its block, at its place or nearest to it
  BlockId block;
  Point position;  ///< [m] in the reference configuration; of a distance the middle
  Quantity quantity = Quantity::uy;
  std::vector<NodeWeight> weights{};     ///< none: it reads how far its node goes up
  std::optional<BlockId> other_block{};  ///< of a distance between two blocks the second
};

/// The point of a block at a place: at the node that is nearest to it.
ControlPoint point_at(const std::string& name, const Mesh& mesh, BlockId block, const Point& place);

/// Of the kinds that are asked for: T1..: upper corners of each block of the top course; A1..: intrados
/// corners of each arch block that reaches the intrados; left to right; F1..: the middles of all blocks whose
/// face is seen.
std::vector<ControlPoint> find_control_points(const BlockLayout& layout, const Mesh& mesh,
                                              const ControlPointDescription& kinds);

/// Those of the description, then its sensors, in its order. Throws InputError, naming the sensor, for one
/// that cannot be placed and for names that are there already.
std::vector<ControlPoint> find_control_points(const BlockLayout& layout, const Mesh& mesh,
                                              const BridgeDescription& description);

/// Does the scene lack a block without which the point shows nothing?
bool lacks(const Scene& scene, const ControlPoint& point);

/// What a point shows [m or rad]; NaN where its block is gone.
double reading_at(const ControlPoint& point, const Field& field);

/// What each of the points shows.
Eigen::VectorXd readings_at(const std::vector<ControlPoint>& points, const Field& field);

}  // namespace voussoir
