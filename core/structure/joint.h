#pragma once
/// @file Where two blocks meet in the reference configuration.

#include <array>
#include <vector>

#include "core/structure/bridge_description.h"
#include "core/structure/mesh.h"

namespace voussoir {

/// One straight stretch in which a boundary edge of one block faces a boundary edge of another. Block `first`
/// lies on the left of its edge, so the stretch's normal (edge direction turned clockwise) points from
/// `first` to `second`. A material point at parameter s in [0,1] of the stretch sits on the first edge at
/// (1-w) from + w to, w = first_at[0] + s (first_at[1] - first_at[0]), and likewise on the second.
struct Joint {
  BlockId first;
  BlockId second;
  BoundaryEdge first_edge;
  BoundaryEdge second_edge;
  std::array<double, 2> first_at;   ///< weights of `to` on the first edge at the stretch's two ends
  std::array<double, 2> second_at;  ///< weights of `to` on the second edge at the same two ends
  double length;                    ///< [m]
};

/// The stretch's two ends [m], on the first edge.
std::array<Point, 2> ends_of(const Joint& joint, const Mesh& mesh);

/// The middle of the stretch [m].
Point middle_of(const Joint& joint, const Mesh& mesh);

/// All stretches longer than `tolerance` [m] where edges of different blocks run against each other within
/// it.
std::vector<Joint> find_joints(const Mesh& mesh, double tolerance);

}  // namespace voussoir
