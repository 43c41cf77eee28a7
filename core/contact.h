#pragma once
/// @file The joint law between two boundary edges of different blocks in their current places.
///
/// Symbols. Edge A runs from a0 to a1 with its block on the left, edge B from b0 to b1 likewise, so that
/// facing edges run against each other. t is the direction of (a1 - a0) / L_A + (b0 - b1) / L_B with the
/// lengths L at rest, n is t turned clockwise and points from A to B; s is the coordinate along t from a0, h
/// the one along n. Both edges cover [s_0, s_1]. Their gap is linear in s; p = p_n <-gap> is the pressure,
/// P_0 and P_1 its integral and first moment.
///
/// The faces that meet at a corner share out what has penetrated there: a face owns the points nearer to it
/// than to the other face. So the stretch in contact begins where the depth is the distance from the corner
/// times the tangent of half the corner's angle. Without this the underside of a block that slides down along
/// another one would be caught by a sliver of the other's upper face. (Faces that form a joint at rest own
/// all of it: where ring blocks press each other hard, the corners' shares would count.)
///
/// Without friction the forces are the exact derivatives of the energy  p_n / 2 integral <-gap>^2 ds  with
/// respect to the four nodes, including how the stretch's ends and the frame (t, n) move, so contact
/// conserves energy, momentum and angular momentum. Friction acts on both edges at the same s; the couple
/// that its lever arm, the gap, would leave is taken up by the frame's derivative too.
///
/// Shear: xi(s), linear along the stretch, is the elastic part of the slip; tau = p_t xi, limited point by
/// point to |tau| <= tan(phi) p and integrated exactly. xi grows by the slip of every step. Where the whole
/// closed stretch slips one way, the slip that is common to all its points is plastic and leaves xi; an open
/// contact forgets xi.

#include <array>

#include "core/lane_number.h"

namespace voussoir {

/// Edges whose directions differ by more than 60 degrees do not face each other; from 45 degrees on, the
/// contact fades (squared length of t before it is made a unit vector: 2 + 2 cos(angle)).
inline constexpr double kNotFacing = 3.0;
inline constexpr double kFullyFacing = 3.4142135623730951;
inline constexpr double kNotFacingLength = 1.7320508075688772;
inline constexpr double kFullyFacingLength = 1.8477590650225735;

/// What the contact of two edges needs to know, the same in all scenes.
struct EdgeContact {
  std::array<int, 4> nodes;          ///< a0, a1, b0, b1
  std::array<int, 2> blocks;         ///< of A and B
  std::array<double, 2> per_length;  ///< 1 / L_A, 1 / L_B [1/m]
  std::array<double, 4>
      corner_share;  ///< 1 / tan(half the angle) at the nodes; 0 where the boundary runs on straight
};

/// Joint material per unit length of joint (times the thickness).
struct ContactMaterial {
  double normal;      ///< [N/m2]
  double tangential;  ///< [N/m2]
  double friction;    ///< tan(phi)
};

/// Elastic part of the slip at s_0 and s_1 [m].
template <class T>
struct alignas(sizeof(T)) ContactShear {
  T at_0;
  T at_1;
};

/// Places of the edges' four nodes and their movements since the last evaluation [m].
template <class T>
struct EdgePlaces {
  std::array<Pair<T>, 4> now;
  std::array<Pair<T>, 4> moved;
};

/// Forces on the four nodes [N].
template <class T>
using EdgeForces = std::array<Pair<T>, 4>;

/// Integral and first moment, about the start of the stretch, of the positive part of a linear function.
template <class T>
struct PositivePart {
  T integral;
  T moment;
  T begin;   ///< where the positive part begins, from the start of the stretch
  T length;  ///< of the positive part
};

/// `at_0` and `at_1` are the function's values at the ends of a stretch of this length.
template <class T>
VOUSSOIR_INLINE PositivePart<T> positive_part(T length, T at_0, T at_1) {
  constexpr double kNoDivisionByZero = 1e-300;
  const T zero = T{};
  const T plus_0 = larger(at_0, zero);
  const T plus_1 = larger(at_1, zero);
  const T sum = plus_0 + plus_1;
  const T share = sum / (magnitude(at_0) + magnitude(at_1) + kNoDivisionByZero);
  PositivePart<T> part;
  part.length = length * share;
  part.begin = at_0 > 0.0 ? zero : length - part.length;
  part.integral = 0.5 * part.length * sum;
  part.moment = part.begin * part.integral + part.length * part.length * (sum + plus_1) * (1.0 / 6.0);
  return part;
}

/// Forces of the contact, and the shear carried over to the next evaluation. False, with the shear forgotten
/// and no forces, if the edges touch in no lane. Lanes in which `present` is 0 have no contact.
template <class T>
VOUSSOIR_INLINE bool contact_forces(const EdgeContact& contact, const ContactMaterial& material,
                                    const T& present, const EdgePlaces<T>& edges, ContactShear<T>& shear,
                                    EdgeForces<T>& forces) {
  const T zero = T{};
  const T one = zero + 1.0;
  const auto& [a0, a1, b0, b1] = edges.now;
  const auto& [moved_a0, moved_a1, moved_b0, moved_b1] = edges.moved;
  const double per_a = contact.per_length[0];
  const double per_b = contact.per_length[1];

  // Do both edges cover a stretch? Most candidates do not, so roots and quotients come later.
  const Pair<T> along_a = a1 - a0;
  const Pair<T> along_b = b0 - b1;
  const Pair<T> to_b1 = b1 - a0;
  const Pair<T> direction = along_a * per_a + along_b * per_b;
  const T squared = dot(direction, direction);
  const T rough_a = dot(direction, along_a);
  const T rough_b1 = dot(direction, to_b1);
  const T rough_b0 = rough_b1 + dot(direction, along_b);
  const auto b_begins = rough_b1 > 0.0;
  const auto b_ends = rough_b0 < rough_a;
  const auto covering = (squared > kNotFacing) & (present > 0.0) & (rough_a > 0.0) & (rough_b0 > 0.0) &
                        (rough_b1 < rough_a) & (rough_b1 < rough_b0);
  if (!any(covering)) {
    shear.at_0 = zero;
    shear.at_1 = zero;
    return false;
  }

  // The frame and the stretch.
  const T per_direction = inverse_root_near_four(squared);
  const Pair<T> t = direction * per_direction;
  const Pair<T> n = {t.y, -t.x};
  const T reach_a = covering ? rough_a * per_direction : one;
  const T reach_b = covering ? dot(t, along_b) : one;
  const T s_b1 = rough_b1 * per_direction;
  const T s_b0 = s_b1 + reach_b;
  const T s_0 = b_begins ? s_b1 : zero;
  const T s_1 = b_ends ? s_b0 : reach_a;

  // The gap.
  const T h_a1 = dot(n, along_a);
  const T h_b1 = dot(n, to_b1);
  const T rise_b = dot(n, along_b);
  const T both = 1.0 / (reach_a * reach_b);
  const T slope_a = h_a1 * both * reach_b;
  const T slope_b = rise_b * both * reach_a;
  const T slope = slope_b - slope_a;
  const T gap_at_a0 = h_b1 - slope_b * s_b1;
  const T gap_0 = gap_at_a0 + slope * s_0;
  const T gap_1 = gap_at_a0 + slope * s_1;
  const auto touching = covering & (s_1 > s_0) & ((gap_0 < 0.0) | (gap_1 < 0.0));
  if (!any(touching)) {
    shear.at_0 = zero;
    shear.at_1 = zero;
    return false;
  }

  // What the faces beyond the corners own is left out.
  const T share_0 = b_begins ? zero + contact.corner_share[3] : zero + contact.corner_share[0];
  const T share_1 = b_ends ? zero + contact.corner_share[2] : zero + contact.corner_share[1];
  constexpr double kSteepest = 0.05;
  const T steep_0 = 1.0 + share_0 * slope;
  const T steep_1 = 1.0 - share_1 * slope;
  const auto owned = touching & (steep_0 > kSteepest) & (steep_1 > kSteepest);
  const T q_0 = 1.0 / (owned ? steep_0 : one);
  const T q_1 = 1.0 / (owned ? steep_1 : one);
  const T s_begin = s_0 + share_0 * q_0 * larger(-gap_0, zero);
  const T s_end = s_1 - share_1 * q_1 * larger(-gap_1, zero);
  const auto closed = owned & (s_end > s_begin);

  // Pressure over the closed part, and the energy per length at the two ends.
  const T p_begin = closed ? -material.normal * (gap_at_a0 + slope * s_begin) : zero;
  const T p_end = closed ? -material.normal * (gap_at_a0 + slope * s_end) : zero;
  const PositivePart<T> pressure = positive_part<T>(s_end - s_begin, p_begin, p_end);
  const T p_0 = larger(p_begin, zero);
  const T p_1 = larger(p_end, zero);
  const double half_compliance = 0.5 / material.normal;
  const T energy_0 = half_compliance * p_0 * p_0 * q_0;
  const T energy_1 = half_compliance * p_1 * p_1 * q_1;
  const T left_out_0 = share_0 * energy_0;
  const T left_out_1 = share_1 * energy_1;
  const T total = pressure.integral - left_out_0 - left_out_1;
  const T moment = pressure.moment + s_begin * pressure.integral - left_out_0 * s_begin - left_out_1 * s_end;

  // Slip and shear.
  const T move_a0 = dot(t, moved_a0);
  const T stretch_a = (dot(t, moved_a1) - move_a0) * both * reach_b;
  const T move_b1 = dot(t, moved_b1);
  const T stretch_b = (dot(t, moved_b0) - move_b1) * both * reach_a;
  const T slip_at_a0 = move_b1 - stretch_b * s_b1 - move_a0;
  const T slip_slope = stretch_b - stretch_a;
  const T xi_0 = shear.at_0 + slip_at_a0 + slip_slope * s_0;
  const T xi_1 = shear.at_1 + slip_at_a0 + slip_slope * s_1;
  const T s_first = s_begin + pressure.begin;
  const T xi_slope = (xi_1 - xi_0) / (touching ? s_1 - s_0 : one);
  const T tau_0 = material.tangential * (xi_0 + xi_slope * (s_first - s_0));
  const T tau_1 = tau_0 + material.tangential * xi_slope * pressure.length;
  const T cap_0 = material.friction * p_0;
  const T cap_1 = material.friction * p_1;
  const PositivePart<T> above = positive_part<T>(pressure.length, tau_0 - cap_0, tau_1 - cap_1);
  const PositivePart<T> below = positive_part<T>(pressure.length, -tau_0 - cap_0, -tau_1 - cap_1);
  const T drag = 0.5 * pressure.length * (tau_0 + tau_1) - above.integral + below.integral;
  const T drag_moment = pressure.length * pressure.length * (tau_0 + 2.0 * tau_1) * (1.0 / 6.0) -
                        above.moment + below.moment + s_first * drag;
  const T common_above = larger(zero, smaller(tau_0 - cap_0, tau_1 - cap_1));
  const T common_below = larger(zero, smaller(-tau_0 - cap_0, -tau_1 - cap_1));
  const T plastic = (common_above - common_below) * (1.0 / material.tangential);
  const auto in_contact = pressure.length > 0.0;
  shear.at_0 = in_contact ? xi_0 - plastic : zero;
  shear.at_1 = in_contact ? xi_1 - plastic : zero;

  // Along t and n on every node.
  const T normal_a1 = moment * both * reach_b;
  const T normal_a0 = total - normal_a1;
  const T normal_b0 = (moment - s_b1 * total) * both * reach_a;
  const T normal_b1 = total - normal_b0;
  const T drag_a1 = drag_moment * both * reach_b;
  const T drag_a0 = drag - drag_a1;
  const T drag_b0 = (drag_moment - s_b1 * drag) * both * reach_a;
  const T drag_b1 = drag - drag_b0;
  T along_a0 = slope_a * normal_a0 + drag_a0 + (b_begins ? zero : energy_0);
  T along_a1 = slope_a * normal_a1 + drag_a1 - (b_ends ? zero : energy_1);
  T along_b0 = -slope_b * normal_b0 - drag_b0 - (b_ends ? energy_1 : zero);
  T along_b1 = -slope_b * normal_b1 - drag_b1 + (b_begins ? energy_0 : zero);

  // The frame turns with the edges.
  const T turning = (normal_a1 * reach_a - normal_b1 * s_b1 - normal_b0 * s_b0 + h_a1 * along_a1 +
                     h_b1 * along_b1 + (h_b1 + rise_b) * along_b0) *
                    per_direction;
  T across_a0 = -normal_a0 - per_a * turning;
  T across_a1 = -normal_a1 + per_a * turning;
  T across_b0 = normal_b0 + per_b * turning;
  T across_b1 = normal_b1 - per_b * turning;

  // Edges that hardly face each other.
  if (any(closed & (squared < kFullyFacing))) {
    const T length_of_direction = squared * per_direction;
    const T x = smaller(one, larger(zero, (length_of_direction - kNotFacingLength) /
                                              (kFullyFacingLength - kNotFacingLength)));
    const T weight = x * x * (3.0 - 2.0 * x);
    const T weight_slope = 6.0 * x * (1.0 - x) / (kFullyFacingLength - kNotFacingLength);
    const T energy = pressure.length * (p_0 * p_0 + p_0 * p_1 + p_1 * p_1) * (half_compliance / 3.0);
    const T pull = energy * weight_slope;
    along_a0 = weight * along_a0 + per_a * pull;
    along_a1 = weight * along_a1 - per_a * pull;
    along_b0 = weight * along_b0 - per_b * pull;
    along_b1 = weight * along_b1 + per_b * pull;
    across_a0 = across_a0 * weight;
    across_a1 = across_a1 * weight;
    across_b0 = across_b0 * weight;
    across_b1 = across_b1 * weight;
  }
  forces = {t * along_a0 + n * across_a0, t * along_a1 + n * across_a1, t * along_b0 + n * across_b0,
            t * along_b1 + n * across_b1};
  return true;
}

}  // namespace voussoir
