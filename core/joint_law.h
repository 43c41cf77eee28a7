#pragma once
/// @file The joint law: what two faces do to each other across one straight stretch of a joint.
///
/// Symbols and signs, along s in [0,1] of a stretch of length L:
///   gap(s)   [m]  opening, positive when the faces are apart; linear in s
///   slip(s)  [m]  movement of the second face along the joint's direction relative to the first; linear in s
///   sigma    [Pa] pressure, p_n <-gap>; never tension
///   tau      [Pa] shear stress, p_t slip, limited to |tau| <= tan(phi) sigma (Coulomb; dry, no cohesion)
/// A stretch's state is the vector (gap_0, slip_0, gap_1, slip_1) of its two ends.

#include <Eigen/Core>

#include "core/bridge_description.h"

namespace voussoir {

using JointState = Eigen::Vector4d;  ///< (gap_0, slip_0, gap_1, slip_1) [m]

/// Work-conjugate of the state: virtual work = force . variation of state.
struct JointResponse {
  Eigen::Vector4d force;    ///< [N]
  Eigen::Matrix4d tangent;  ///< d force / d state [N/m]; not symmetric where the joint slips
};

/// Integrates the law over a stretch exactly: gap and slip are linear, so the stretch falls into at most four
/// parts that are open, sticking or slipping as a whole, and the stresses are linear in each. The stresses
/// are continuous at the parts' ends, so the tangent is the exact derivative. `area` is length times
/// thickness [m2].
JointResponse integrate_joint(const JointMaterial& material, double area, const JointState& state);

/// The tangent if the whole stretch were closed and sticking.
Eigen::Matrix4d bonded_joint_tangent(const JointMaterial& material, double area);

}  // namespace voussoir
