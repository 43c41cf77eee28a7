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
#include <string_view>

#include "core/structure/bridge_description.h"

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

/// How the law is integrated over a stretch. All but `exact` are there to be compared with it.
enum class JointRule {
  exact,      ///< integrate_joint without a rule
  lobatto_3,  ///< at both ends and the middle: 0.2 % off in displacements, many per cent in a removal's
              ///< signal
  gauss_16    ///< at 16 Gauss points
};

/// "exact", "lobatto-3", "gauss-16"
std::string_view to_string(JointRule rule);

/// The same by a quadrature rule: every point is open, sticking or slipping.
JointResponse integrate_joint(const JointMaterial& material, double area, const JointState& state,
                              JointRule rule);

/// The tangent if the whole stretch were closed and sticking.
Eigen::Matrix4d bonded_joint_tangent(const JointMaterial& material, double area);

}  // namespace voussoir
