#pragma once
/// @file Gap and slip of a joint stretch as functions of its eight nodal displacements, with exact
/// derivatives.
///
/// Symbols: corners 0,1 are `from`,`to` of the first edge, 2,3 of the second; q = (x0,y0,..,x3,y3) their
/// displacements. theta is the mean of the two edges' rotations; t the reference direction of the joint
/// turned by theta; n is t turned clockwise, from the first block to the second. At the stretch's end k the
/// faces are apart by j_k = x_second - x_first (material points that face each other in the reference
/// configuration), and gap_k = n . j_k, slip_k = t . j_k.
///
/// t is found without angles: it halves the angle between the joint's direction turned as the first edge is
/// and as the second is.

#include <Eigen/Core>
#include <array>

#include "core/law/joint_law.h"
#include "core/structure/joint.h"

namespace voussoir {

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;

/// What the kinematics need of the reference configuration.
struct JointFrame {
  Point direction;                         ///< unit vector t at rest
  Point first_along;                       ///< first edge, from -> to [m]
  Point second_along;                      ///< second edge, to -> from [m], so that both run along t
  std::array<Point, 2> from_edge;          ///< (cos, sin) of the angle from each edge to t, at rest
  std::array<Eigen::Vector4d, 2> weights;  ///< of the four corners in j_k
  std::array<Point, 2> offset;             ///< j_k at rest [m]: zero but for gaps and overlaps in the input
};

JointFrame make_joint_frame(const Joint& joint, const Mesh& mesh);

/// Where the joint is.
struct JointPose {
  JointState state;
  Point along;                ///< t
  std::array<Point, 2> turn;  ///< d theta / d vector of each edge [1/m]
};

/// Not defined where one edge has turned by half a turn against the other.
JointPose joint_pose(const JointFrame& frame, const Vector8d& displacement);

/// Forces on the corners that are work-conjugate to the displacements as `force` is to the state.
Vector8d corner_forces(const JointFrame& frame, const JointPose& pose, const Eigen::Vector4d& force);

struct JointKinematics : JointPose {
  Eigen::Matrix<double, 4, 8> gradient;  ///< d state / d q; corner_forces are gradient^T force
};

/// Objective: a rigid motion of both blocks leaves the state unchanged, so forces gradient^T F are in
/// balance.
JointKinematics joint_kinematics(const JointFrame& frame, const Vector8d& displacement);

/// sum_k force_k d2 state_k / d q2: how the directions of given joint forces turn [N/m].
Matrix8d joint_geometric_stiffness(const JointFrame& frame, const Vector8d& displacement,
                                   const JointKinematics& kinematics, const Eigen::Vector4d& force);

}  // namespace voussoir
