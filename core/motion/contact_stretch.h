#pragma once
/// @file Where two boundary edges in their current places face each other; symbols are those of contact.h.

#include <array>

#include "core/simd/pair.h"
#include "core/structure/bridge_description.h"

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
  std::array<double, 2> per_length;  ///< 1 / L_A, 1 / L_B [1/m]
  std::array<double, 4>
      corner_share;  ///< 1 / tan(half the angle) at the nodes; 0 where the boundary runs on straight
  bool joined;       ///< they form a joint at rest: all corner shares are 0
  double deepest;    ///< faces that overlap by more are seen from behind and do not touch [m]
  ContactMaterial material;
  std::array<bool, 2> quick{};  ///< do the edges' blocks take short steps (pace.h)?

  bool meets_quick() const { return quick[0] || quick[1]; }
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
VOUSSOIR_INLINE RoughCover<T> rough_cover(const EdgeContact& contact, const T& found,
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
  c.covering =
      (c.squared > kNotFacing) & (found > 0.0) & (c.a1 > 0.0) & (c.b0 > 0.0) & (c.b1 < c.a1) & (c.b1 < c.b0);
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
VOUSSOIR_INLINE Stretch<T> stretch_of(const EdgeContact& contact, const RoughCover<T>& c) {
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
  const T least = smaller(x.gap_0, x.gap_1);
  x.touching = c.covering & (x.s_1 > x.s_0) & (least < 0.0) & (least > -contact.deepest);
  return x;
}

}  // namespace voussoir
