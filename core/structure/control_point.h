#pragma once
/// @file The points whose vertical displacement is measured (paper, Fig. 1).

#include <string>
#include <vector>

#include "core/structure/mesh.h"

namespace voussoir {

struct ControlPoint {
  std::string name;  ///< T1.. on top, A1.. on the intrados, from left to right
  NodeId node;
  BlockId block;
  Point position;  ///< [m] in the reference configuration
};

/// The point of a block at a place: at the node that is nearest to it.
ControlPoint point_at(const std::string& name, const Mesh& mesh, BlockId block, const Point& place);

/// T1..: upper corners of each block of the top course; A1..: intrados corners of each arch block that
/// reaches the intrados; left to right.
std::vector<ControlPoint> find_control_points(const BlockLayout& layout, const Mesh& mesh,
                                              const BridgeDescription& description);

/// Vertical displacements [m] of the points; NaN where the block is gone.
Eigen::VectorXd vertical_displacements(const Field& field, const std::vector<ControlPoint>& points);

}  // namespace voussoir
