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
/// Pressure, friction and its memory are those of core/law/joint_law.h; in motion xi, the elastic slip, is
/// what is kept: it grows by the slip of every step and loses what is plastic; an open contact forgets it.
/// Slip is the movement along t of points that face each other, t . (x_B - x_A), so that where the faces are
/// apart the frame's turning counts as well: a block that rocks on its edge does not slip at its open end.

#include "core/law/joint_law.h"
#include "core/motion/contact_stretch.h"

namespace voussoir {

/// A stress along the stretch: integral and first moment about a0.
template <class T>
struct Traction {
  T total;
  T moment;
};

/// What a face owns of the stretch.
template <class T>
struct OwnedPart {
  T begin;
  T end;
  T share_0;  ///< the corner's at its beginning and end
  T share_1;
  T per_steep_0;  ///< how fast the ends move as the faces do
  T per_steep_1;
  Mask<T> closed;
};

template <class T>
VOUSSOIR_INLINE OwnedPart<T> owned_part(const EdgeContact& contact, const RoughCover<T>& c,
                                        const Stretch<T>& x) {
  constexpr double kSteepest = 0.05;  // beyond, the bisector of the corner never meets the other face
  const T zero = T{};
  const T one = zero + 1.0;
  if (contact.joined) return {x.s_0, x.s_1, zero, zero, one, one, x.touching};
  const auto& share = contact.corner_share;
  OwnedPart<T> r;
  r.share_0 = c.b_begins ? zero + share[3] : zero + share[0];
  r.share_1 = c.b_ends ? zero + share[2] : zero + share[1];
  const T steep_0 = 1.0 + r.share_0 * x.slope;
  const T steep_1 = 1.0 - r.share_1 * x.slope;
  const auto owned = x.touching & (steep_0 > kSteepest) & (steep_1 > kSteepest);
  const T bounded_0 = owned ? steep_0 : one;
  const T bounded_1 = owned ? steep_1 : one;
  const T per_both = 1.0 / (bounded_0 * bounded_1);
  r.per_steep_0 = per_both * bounded_1;
  r.per_steep_1 = per_both * bounded_0;
  r.begin = x.s_0 + r.share_0 * r.per_steep_0 * larger(-x.gap_0, zero);
  r.end = x.s_1 - r.share_1 * r.per_steep_1 * larger(-x.gap_1, zero);
  r.closed = owned & (r.end > r.begin);
  return r;
}

/// Pressure over the closed part of the stretch, and the energy's pull on the nodes that bound it.
template <class T>
struct Closure {
  Traction<T> pressure;
  T begin;  ///< s of the closed part's beginning
  T length;
  T p_0;  ///< pressure at its ends [N/m]
  T p_1;
  T pull_0;  ///< along t on the node at the stretch's beginning [N]
  T pull_1;  ///< against t on the node at its end [N]
};

template <class T>
VOUSSOIR_INLINE Closure<T> closure_of(const EdgeContact& contact, const OwnedPart<T>& own,
                                      const Stretch<T>& x) {
  const ContactMaterial& material = contact.material;
  const T zero = T{};
  const T p_begin = own.closed ? -material.normal * (x.gap_at_a0 + x.slope * own.begin) : zero;
  const T p_end = own.closed ? -material.normal * (x.gap_at_a0 + x.slope * own.end) : zero;
  const PositivePart<T> part = positive_part<T>(own.end - own.begin, p_begin, p_end);
  Closure<T> r;
  r.p_0 = larger(p_begin, zero);
  r.p_1 = larger(p_end, zero);
  r.pull_0 = material.half_compliance * r.p_0 * r.p_0 * own.per_steep_0;
  r.pull_1 = material.half_compliance * r.p_1 * r.p_1 * own.per_steep_1;
  // A deeper face owns less: this much of the pressure does no work.
  const T left_out_0 = own.share_0 * r.pull_0;
  const T left_out_1 = own.share_1 * r.pull_1;
  r.pressure.total = part.integral - left_out_0 - left_out_1;
  r.pressure.moment = part.moment + own.begin * part.integral - left_out_0 * own.begin - left_out_1 * own.end;
  r.begin = own.begin + part.begin;
  r.length = part.length;
  return r;
}

/// A quantity that is linear along the stretch.
template <class T>
struct AlongStretch {
  T at_a0;
  T slope;
  VOUSSOIR_INLINE T operator()(T s) const { return at_a0 + slope * s; }
};

/// Movement of B against A in a direction, along the stretch.
template <class T>
VOUSSOIR_INLINE AlongStretch<T> relative_movement(const std::array<Pair<T>, 4>& moved,
                                                  const Pair<T>& direction, const Stretch<T>& x) {
  const auto& [moved_a0, moved_a1, moved_b0, moved_b1] = moved;
  const T move_a0 = dot(direction, moved_a0);
  const T slope_a = (dot(direction, moved_a1) - move_a0) * x.per_reach_a;
  const T move_b1 = dot(direction, moved_b1);
  const T slope_b = (dot(direction, moved_b0) - move_b1) * x.per_reach_b;
  return {move_b1 - slope_b * x.s_b1 - move_a0, slope_b - slope_a};
}

/// How far the frame turned in the last step, counter-clockwise [rad].
template <class T>
VOUSSOIR_INLINE T frame_turn(const EdgeContact& contact, const std::array<Pair<T>, 4>& moved,
                             const Stretch<T>& x) {
  const Pair<T> change =
      (moved[1] - moved[0]) * contact.per_length[0] + (moved[2] - moved[3]) * contact.per_length[1];
  return -dot(x.n, change) * x.per_direction;
}

/// Shear stress on the closed part, and what the shear is afterwards.
template <class T>
VOUSSOIR_INLINE Traction<T> friction_of(const EdgeContact& contact, const EdgePlaces<T>& edges,
                                        const Stretch<T>& x, const Closure<T>& closure,
                                        ContactShear<T>& shear) {
  const ContactMaterial& material = contact.material;
  const T zero = T{};
  const T one = zero + 1.0;
  // The change of t . (x_B - x_A) in the last step, to second order: frame and gap are those of the step's
  // middle.
  const AlongStretch<T> along = relative_movement(edges.moved, x.t, x);
  const AlongStretch<T> opening = relative_movement(edges.moved, x.n, x);
  const T turn = frame_turn(contact, edges.moved, x);
  const double to_middle = 1.0 + 2.0 * edges.ahead;
  const T xi_0 = shear.at_0 + along(x.s_0) - turn * (x.gap_0 - to_middle * opening(x.s_0));
  const T xi_1 = shear.at_1 + along(x.s_1) - turn * (x.gap_1 - to_middle * opening(x.s_1));

  const T xi_slope = (xi_1 - xi_0) / (x.touching ? x.s_1 - x.s_0 : one);
  const T tau_0 = material.tangential * (xi_0 + xi_slope * (closure.begin - x.s_0));
  const T tau_1 = tau_0 + material.tangential * xi_slope * closure.length;
  const T cap_0 = material.friction * closure.p_0;
  const T cap_1 = material.friction * closure.p_1;
  const FrictionExcess<T> excess = friction_excess<T>(closure.length, tau_0, tau_1, cap_0, cap_1);
  Traction<T> drag;
  drag.total = 0.5 * closure.length * (tau_0 + tau_1) - excess.above.integral + excess.below.integral;
  drag.moment = closure.length * closure.length * (tau_0 + 2.0 * tau_1) * (1.0 / 6.0) - excess.above.moment +
                excess.below.moment + closure.begin * drag.total;

  const T plastic = excess.common * material.per_tangential;
  const auto in_contact = closure.length > 0.0;
  shear.at_0 = in_contact ? xi_0 - plastic : zero;
  shear.at_1 = in_contact ? xi_1 - plastic : zero;
  return drag;
}

/// A traction's shares of the four nodes, in the order a0, a1, b0, b1; positive on all.
template <class T>
VOUSSOIR_INLINE std::array<T, 4> nodal_shares(const Traction<T>& traction, const Stretch<T>& x) {
  const T a1 = traction.moment * x.per_reach_a;
  const T b0 = (traction.moment - x.s_b1 * traction.total) * x.per_reach_b;
  return {traction.total - a1, a1, b0, traction.total - b0};
}

/// Forces on the nodes along t and n.
template <class T>
struct FrameForces {
  std::array<T, 4> along;
  std::array<T, 4> across;
};

/// What pressure, friction and the pulls at the ends do to the nodes, and what the turning of the frame adds.
template <class T>
VOUSSOIR_INLINE FrameForces<T> frame_forces(const EdgeContact& contact, const RoughCover<T>& c,
                                            const Stretch<T>& x, const Closure<T>& closure,
                                            const Traction<T>& drag) {
  const T zero = T{};
  const std::array<T, 4> p = nodal_shares(closure.pressure, x);
  const std::array<T, 4> d = nodal_shares(drag, x);
  FrameForces<T> f;
  f.along[0] = x.slope_a * p[0] + d[0] + (c.b_begins ? zero : closure.pull_0);
  f.along[1] = x.slope_a * p[1] + d[1] - (c.b_ends ? zero : closure.pull_1);
  f.along[2] = -x.slope_b * p[2] - d[2] - (c.b_ends ? closure.pull_1 : zero);
  f.along[3] = -x.slope_b * p[3] - d[3] + (c.b_begins ? closure.pull_0 : zero);
  const T turning = (p[1] * x.reach_a - p[3] * x.s_b1 - p[2] * x.s_b0 + x.h_a1 * f.along[1] +
                     x.h_b1 * f.along[3] + x.h_b0 * f.along[2]) *
                    x.per_direction;
  f.across[0] = -p[0] - contact.per_length[0] * turning;
  f.across[1] = -p[1] + contact.per_length[0] * turning;
  f.across[2] = p[2] + contact.per_length[1] * turning;
  f.across[3] = p[3] - contact.per_length[1] * turning;
  return f;
}

/// Weakens the forces of edges that hardly face each other, and adds the derivative of the weight.
template <class T>
VOUSSOIR_INLINE void fade(const EdgeContact& contact, const RoughCover<T>& c, const Stretch<T>& x,
                          const Closure<T>& closure, FrameForces<T>& f) {
  constexpr double kRange = kFullyFacingLength - kNotFacingLength;
  const T one = T{} + 1.0;
  const T share = smaller(one, larger(T{}, (c.squared * x.per_direction - kNotFacingLength) / kRange));
  const T weight = share * share * (3.0 - 2.0 * share);
  const T weight_slope = 6.0 * share * (1.0 - share) / kRange;
  const T squares = closure.p_0 * closure.p_0 + closure.p_0 * closure.p_1 + closure.p_1 * closure.p_1;
  const T pull = closure.length * squares * contact.material.sixth_compliance * weight_slope;
  for (std::size_t i = 0; i < 4; ++i) {
    f.along[i] = f.along[i] * weight;
    f.across[i] = f.across[i] * weight;
  }
  f.along[0] += contact.per_length[0] * pull;
  f.along[1] -= contact.per_length[0] * pull;
  f.along[2] -= contact.per_length[1] * pull;
  f.along[3] += contact.per_length[1] * pull;
}

/// Forces of the contact, and the shear carried over to the next evaluation. False, with the shear forgotten
/// and no forces, if the edges touch in no lane. Lanes in which `found` is 0 have no contact.
template <class T>
VOUSSOIR_INLINE bool contact_forces(const EdgeContact& contact, const T& found, const EdgePlaces<T>& edges,
                                    ContactShear<T>& shear, EdgeForces<T>& forces) {
  const RoughCover<T> cover = rough_cover<T>(contact, found, edges.now);
  const bool some_cover = any(cover.covering);
  const Stretch<T> stretch = some_cover ? stretch_of(contact, cover) : Stretch<T>{};
  const bool touching = some_cover && any(stretch.touching);
  const OwnedPart<T> own = touching ? owned_part(contact, cover, stretch) : OwnedPart<T>{};
  if (!touching || !any(own.closed)) {
    shear = {T{}, T{}};
    return false;
  }
  const Closure<T> closure = closure_of(contact, own, stretch);
  const Traction<T> drag = friction_of(contact, edges, stretch, closure, shear);
  FrameForces<T> f = frame_forces(contact, cover, stretch, closure, drag);
  if (any(own.closed & (cover.squared < kFullyFacing))) fade(contact, cover, stretch, closure, f);
  for (std::size_t i = 0; i < 4; ++i) forces[i] = stretch.t * f.along[i] + stretch.n * f.across[i];
  return true;
}

}  // namespace voussoir
