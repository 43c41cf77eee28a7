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

#include <array>

#include "core/law/joint_law.h"
#include "core/simd/pair.h"

namespace voussoir {

/// Edges whose directions differ by more than 60 degrees do not face each other; from 45 degrees on, the
/// contact fades (squared length of t before it is made a unit vector: 2 + 2 cos(angle)).
inline constexpr double kNotFacing = 3.0;
inline constexpr double kFullyFacing = 3.4142135623730951;
inline constexpr double kNotFacingLength = 1.7320508075688772;
inline constexpr double kFullyFacingLength = 1.8477590650225735;

/// A joint's law per length of contact (times the thickness), and what the kernels need of it.
struct ContactMaterial {
  ContactMaterial() = default;
  ContactMaterial(const JointMaterial& joint, double thickness);

  double normal = 0.0;            ///< [N/m2]
  double tangential = 0.0;        ///< [N/m2]
  double friction = 0.0;          ///< mu
  double half_compliance = 0.0;   ///< 1 / (2 normal)
  double sixth_compliance = 0.0;  ///< 1 / (6 normal)
  double per_tangential = 0.0;    ///< 1 / tangential
};

/// What the contact of two edges needs to know, the same in all scenes of a variant.
struct EdgeContact {
  std::array<int, 4> nodes;          ///< a0, a1, b0, b1
  std::array<int, 2> blocks;         ///< of A and B
  std::array<double, 2> per_length;  ///< 1 / L_A, 1 / L_B [1/m]
  std::array<double, 4>
      corner_share;  ///< 1 / tan(half the angle) at the nodes; 0 where the boundary runs on straight
  ContactMaterial material;
};

/// Elastic part of the slip at s_0 and s_1 [m].
template <class T>
struct alignas(sizeof(T)) ContactShear {
  T at_0;
  T at_1;
};

/// Places of the edges' four nodes and their movements in the last step [m]; the places are those `ahead`
/// steps later.
template <class T>
struct EdgePlaces {
  std::array<Pair<T>, 4> now;
  std::array<Pair<T>, 4> moved;
  double ahead = 0.0;
};

/// Forces on the four nodes [N].
template <class T>
using EdgeForces = std::array<Pair<T>, 4>;

/// A condition in every lane.
template <class T>
using Mask = decltype((T{} < T{}) & (T{} < T{}));

/// Where both edges lie along the direction before it is made a unit vector: all that most candidates need.
template <class T>
struct RoughCover {
  Pair<T> along_a;    ///< a1 - a0
  Pair<T> along_b;    ///< b0 - b1
  Pair<T> to_b1;      ///< b1 - a0
  Pair<T> direction;  ///< t times its length
  T squared;          ///< of that length
  T a1;               ///< coordinates along the direction, from a0
  T b1;
  T b0;
  Mask<T> b_begins;  ///< the stretch begins at b1, otherwise at a0
  Mask<T> b_ends;    ///< the stretch ends at b0, otherwise at a1
  Mask<T> covering;  ///< the edges face each other and cover a stretch
};

template <class T>
VOUSSOIR_INLINE RoughCover<T> rough_cover(const EdgeContact& contact, const T& present,
                                          const std::array<Pair<T>, 4>& places) {
  const auto& [a0, a1, b0, b1] = places;
  RoughCover<T> c;
  c.along_a = a1 - a0;
  c.along_b = b0 - b1;
  c.to_b1 = b1 - a0;
  c.direction = c.along_a * contact.per_length[0] + c.along_b * contact.per_length[1];
  c.squared = dot(c.direction, c.direction);
  c.a1 = dot(c.direction, c.along_a);
  c.b1 = dot(c.direction, c.to_b1);
  c.b0 = c.b1 + dot(c.direction, c.along_b);
  c.b_begins = c.b1 > 0.0;
  c.b_ends = c.b0 < c.a1;
  c.covering = (c.squared > kNotFacing) & (present > 0.0) & (c.a1 > 0.0) & (c.b0 > 0.0) & (c.b1 < c.a1) &
               (c.b1 < c.b0);
  return c;
}

/// The frame (t, n), the stretch in it, and the gap over the stretch.
template <class T>
struct Stretch {
  T per_direction;  ///< 1 / length of the direction
  Pair<T> t;
  Pair<T> n;
  T reach_a;  ///< extents of the edges along t
  T reach_b;
  T per_reach_a;
  T per_reach_b;
  T s_b1;
  T s_b0;
  T s_0;  ///< the stretch
  T s_1;
  T h_a1;  ///< coordinates along n, from a0
  T h_b1;
  T h_b0;
  T slope_a;
  T slope_b;
  T gap_at_a0;  ///< the gap's line at s = 0
  T slope;      ///< d gap / d s
  T gap_0;      ///< at s_0 and s_1
  T gap_1;
  Mask<T> touching;
};

template <class T>
VOUSSOIR_INLINE Stretch<T> stretch_of(const RoughCover<T>& c) {
  const T one = T{} + 1.0;
  Stretch<T> x;
  x.per_direction = inverse_root_near_four(c.squared);
  x.t = c.direction * x.per_direction;
  x.n = {x.t.y, -x.t.x};
  x.reach_a = c.covering ? c.a1 * x.per_direction : one;
  x.reach_b = c.covering ? dot(x.t, c.along_b) : one;
  x.s_b1 = c.b1 * x.per_direction;
  x.s_b0 = x.s_b1 + x.reach_b;
  x.s_0 = c.b_begins ? x.s_b1 : T{};
  x.s_1 = c.b_ends ? x.s_b0 : x.reach_a;
  const T per_both = 1.0 / (x.reach_a * x.reach_b);
  x.per_reach_a = per_both * x.reach_b;
  x.per_reach_b = per_both * x.reach_a;
  const T rise_b = dot(x.n, c.along_b);
  x.h_a1 = dot(x.n, c.along_a);
  x.h_b1 = dot(x.n, c.to_b1);
  x.h_b0 = x.h_b1 + rise_b;
  x.slope_a = x.h_a1 * x.per_reach_a;
  x.slope_b = rise_b * x.per_reach_b;
  x.slope = x.slope_b - x.slope_a;
  x.gap_at_a0 = x.h_b1 - x.slope_b * x.s_b1;
  x.gap_0 = x.gap_at_a0 + x.slope * x.s_0;
  x.gap_1 = x.gap_at_a0 + x.slope * x.s_1;
  x.touching = c.covering & (x.s_1 > x.s_0) & ((x.gap_0 < 0.0) | (x.gap_1 < 0.0));
  return x;
}

/// A stress along the stretch: integral and first moment about a0.
template <class T>
struct Traction {
  T total;
  T moment;
};

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
  Mask<T> closed;
};

template <class T>
VOUSSOIR_INLINE Closure<T> closure_of(const EdgeContact& contact, const RoughCover<T>& c,
                                      const Stretch<T>& x) {
  const ContactMaterial& material = contact.material;
  constexpr double kSteepest = 0.05;  // beyond, the bisector of the corner never meets the other face
  const T zero = T{};
  const T one = zero + 1.0;
  const auto& share = contact.corner_share;
  const T share_0 = c.b_begins ? zero + share[3] : zero + share[0];
  const T share_1 = c.b_ends ? zero + share[2] : zero + share[1];
  const T steep_0 = 1.0 + share_0 * x.slope;
  const T steep_1 = 1.0 - share_1 * x.slope;
  const auto owned = x.touching & (steep_0 > kSteepest) & (steep_1 > kSteepest);
  const T q_0 = 1.0 / (owned ? steep_0 : one);
  const T q_1 = 1.0 / (owned ? steep_1 : one);
  const T s_begin = x.s_0 + share_0 * q_0 * larger(-x.gap_0, zero);
  const T s_end = x.s_1 - share_1 * q_1 * larger(-x.gap_1, zero);

  Closure<T> r;
  r.closed = owned & (s_end > s_begin);
  const T p_begin = r.closed ? -material.normal * (x.gap_at_a0 + x.slope * s_begin) : zero;
  const T p_end = r.closed ? -material.normal * (x.gap_at_a0 + x.slope * s_end) : zero;
  const PositivePart<T> part = positive_part<T>(s_end - s_begin, p_begin, p_end);
  r.p_0 = larger(p_begin, zero);
  r.p_1 = larger(p_end, zero);
  r.pull_0 = material.half_compliance * r.p_0 * r.p_0 * q_0;
  r.pull_1 = material.half_compliance * r.p_1 * r.p_1 * q_1;
  const T left_out_0 = share_0 * r.pull_0;  // a deeper face owns less: this much of the pressure does no work
  const T left_out_1 = share_1 * r.pull_1;
  r.pressure.total = part.integral - left_out_0 - left_out_1;
  r.pressure.moment = part.moment + s_begin * part.integral - left_out_0 * s_begin - left_out_1 * s_end;
  r.begin = s_begin + part.begin;
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
/// and no forces, if the edges touch in no lane. Lanes in which `present` is 0 have no contact.
template <class T>
VOUSSOIR_INLINE bool contact_forces(const EdgeContact& contact, const T& present, const EdgePlaces<T>& edges,
                                    ContactShear<T>& shear, EdgeForces<T>& forces) {
  const RoughCover<T> cover = rough_cover<T>(contact, present, edges.now);
  const bool some_cover = any(cover.covering);
  const Stretch<T> stretch = some_cover ? stretch_of(cover) : Stretch<T>{};
  if (!some_cover || !any(stretch.touching)) {
    shear = {T{}, T{}};
    return false;
  }
  const Closure<T> closure = closure_of(contact, cover, stretch);
  const Traction<T> drag = friction_of(contact, edges, stretch, closure, shear);
  FrameForces<T> f = frame_forces(contact, cover, stretch, closure, drag);
  if (any(closure.closed & (cover.squared < kFullyFacing))) fade(contact, cover, stretch, closure, f);
  for (std::size_t i = 0; i < 4; ++i) forces[i] = stretch.t * f.along[i] + stretch.n * f.across[i];
  return true;
}

}  // namespace voussoir
