#pragma once
/// @file The joint law: what two faces do to each other across one straight stretch of a joint. Statics and
/// motion both use it; a number T is a double or several side by side (core/simd).
///
/// Symbols and signs, along s of a stretch of length L:
///   gap(s)   [m]  opening, positive when the faces are apart; linear in s
///   slip(s)  [m]  movement of the second face along the joint's direction relative to the first; linear in s
///   memory(s) [m] plastic slip: what friction has given way by before; linear in s
///   xi(s)    [m]  elastic slip, slip - memory
///   p        [Pa] pressure, p_n <-gap>; never tension
///   tau      [Pa] shear stress, p_t xi, bounded point by point to |tau| <= mu p (Coulomb; dry, no cohesion)
///
/// Everything is linear by parts, so it is integrated exactly. The stretch is closed where <-gap> is
/// positive: one interval. On it
///     tau = p_t xi - <p_t xi - mu p> + <-p_t xi - mu p>,
/// and each bracket is the positive part of a function that is linear on the closed part: one interval more,
/// where the joint slips in the positive or the negative direction. Elsewhere on the closed part it sticks.
/// So integral, moment and derivative of the stresses are sums over at most three intervals (positive_part).
/// The stresses are continuous at the intervals' ends, so the derivative of the integrals is the integral of
/// the derivatives.
///
/// Memory: where the whole closed part slips one way, the slip that is common to all its points is plastic
/// (plastic slip that differs along the stretch would not be linear); the shear stress is the same after it
/// has gone into the memory. An open joint forgets: its memory becomes its slip.

#include <Eigen/Core>

#include "core/law/state.h"
#include "core/simd/lanes.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// The positive part of a linear function along a stretch.
template <class T>
struct PositivePart {
  T integral;
  T moment;  ///< first moment about the start of the stretch
  T begin;   ///< where the positive part begins, from the start of the stretch
  T length;  ///< of the positive part
};

/// `at_0` and `at_1` are the function's values at the ends of a stretch of this length.
template <class T>
VOUSSOIR_INLINE PositivePart<T> positive_part(T length, T at_0, T at_1) {
  const T zero = T{};
  if (!any((at_0 <= 0.0) | (at_1 <= 0.0))) {  // as most joints are: no quotients
    const T both = at_0 + at_1;
    return {0.5 * length * both, length * length * (both + at_1) * (1.0 / 6.0), zero, length};
  }
  const T plus_0 = larger(at_0, zero);
  const T plus_1 = larger(at_1, zero);
  const T sum = plus_0 + plus_1;
  const T whole = magnitude(at_0) + magnitude(at_1);
  const T share = whole > 0.0 ? sum / whole : zero;
  PositivePart<T> part;
  part.length = length * share;
  part.begin = at_0 > 0.0 ? zero : length - part.length;
  part.integral = 0.5 * part.length * sum;
  part.moment = part.begin * part.integral + part.length * part.length * (sum + plus_1) * (1.0 / 6.0);
  return part;
}

/// Where friction gives way on the closed part of a stretch, and by how much stress.
template <class T>
struct FrictionExcess {
  PositivePart<T> above;  ///< of tau - cap, in the positive direction
  PositivePart<T> below;  ///< of -tau - cap
  T common;               ///< excess common to all points of the closed part, with its sign [stress]
};

/// `tau` is the unbounded shear stress and `cap` the friction at the ends of the closed part.
template <class T>
VOUSSOIR_INLINE FrictionExcess<T> friction_excess(T closed_length, T tau_0, T tau_1, T cap_0, T cap_1) {
  FrictionExcess<T> excess{};
  if (!any((magnitude(tau_0) > cap_0) | (magnitude(tau_1) > cap_1))) return excess;
  excess.above = positive_part<T>(closed_length, tau_0 - cap_0, tau_1 - cap_1);
  excess.below = positive_part<T>(closed_length, -tau_0 - cap_0, -tau_1 - cap_1);
  const T zero = T{};
  excess.common = larger(zero, smaller(tau_0 - cap_0, tau_1 - cap_1)) -
                  larger(zero, smaller(-tau_0 - cap_0, -tau_1 - cap_1));
  return excess;
}

/// State of a stretch: (gap_0, slip_0, gap_1, slip_1) of its two ends [m].
using JointState = Eigen::Vector4d;

/// A joint's law times the area of its stretch (length times thickness).
struct JointStiffness {
  double normal = 0.0;      ///< p_n area [N/m]
  double tangential = 0.0;  ///< p_t area [N/m]
  double cap = 0.0;         ///< mu p_n area: shear at the bound per penetration [N/m]
};

/// `area` is length times thickness [m2].
JointStiffness joint_stiffness(const JointMaterial& material, double area);

/// Work-conjugate of the state: virtual work = force . variation of state.
struct JointResponse {
  Eigen::Vector4d force;    ///< [N]
  Eigen::Matrix4d tangent;  ///< d force / d state [N/m]; not symmetric where the joint slips
};

/// The law over a whole stretch, and its derivative.
JointResponse integrate_joint(const JointStiffness& joint, const JointMemory& memory,
                              const JointState& state);

/// Its force alone.
Eigen::Vector4d joint_force(const JointStiffness& joint, const JointMemory& memory, const JointState& state);

/// The force by what it comes from; each part is proportional to its own stiffness, so these are derivatives,
/// too: `normal` of ln p_n, `sticking` of ln p_t, `slipping` of ln mu and of ln p_n.
struct JointForceParts {
  Eigen::Vector4d normal;    ///< pressure [N]
  Eigen::Vector4d sticking;  ///< shear where the joint sticks [N]
  Eigen::Vector4d slipping;  ///< shear where it slips [N]

  Eigen::Vector4d sum() const { return normal + sticking + slipping; }
};

JointForceParts joint_force_parts(const JointStiffness& joint, const JointMemory& memory,
                                  const JointState& state);

/// Where the faces of a stretch touch, and where friction gives way there. Shares of the stretch.
struct JointContact {
  double closed = 0.0;
  double sliding = 0.0;  ///< at most `closed`; the rest of it sticks
};

JointContact joint_contact(const JointStiffness& joint, const JointMemory& memory, const JointState& state);

/// What the joint remembers when a stage ends in this state.
JointMemory updated_memory(const JointStiffness& joint, const JointMemory& memory, const JointState& state);

/// How updated_memory (slip_0, slip_1) changes. It has kinks where slip begins or ends; these are derivatives
/// beside them.
struct MemoryDerivatives {
  Eigen::Matrix<double, 2, 4> by_state = Eigen::Matrix<double, 2, 4>::Zero();
  Eigen::Matrix2d by_memory = Eigen::Matrix2d::Identity();
  Eigen::Vector2d by_friction = Eigen::Vector2d::Zero();  ///< by ln mu [m]
  Eigen::Vector2d by_ratio = Eigen::Vector2d::Zero();     ///< by ln (p_t / p_n) [m]
};

MemoryDerivatives memory_derivatives(const JointStiffness& joint, const JointMemory& memory,
                                     const JointState& state);

/// The tangent if the whole stretch were closed and sticking.
Eigen::Matrix4d bonded_joint_tangent(const JointStiffness& joint);

}  // namespace voussoir
