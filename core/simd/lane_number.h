#pragma once
/// @file Numbers that are one double, or several side by side, one for each scene of a group.
///
/// Kernels are templates on such a number. Conditions are masks (bool, or one for each lane), `mask ? a : b`
/// picks lane by lane, and no operation mixes lanes: a lane's bits do not depend on what the other lanes
/// hold.

#include <cmath>
#include <cstdint>

namespace voussoir {

#define VOUSSOIR_INLINE inline __attribute__((always_inline))

template <int W>
struct LanesOf;
template <>
struct LanesOf<1> {
  using Number = double;
};
template <>
struct LanesOf<4> {
  using Number = double __attribute__((vector_size(4 * sizeof(double))));
};

/// W doubles side by side; W is 1 or 4.
template <int W>
using Lanes = typename LanesOf<W>::Number;

template <class T>
inline constexpr int kLaneCount = static_cast<int>(sizeof(T) / sizeof(double));

template <class T>
VOUSSOIR_INLINE double lane(const T& number, [[maybe_unused]] int i) {
  if constexpr (kLaneCount<T> == 1)
    return number;
  else
    return number[i];
}

template <class T>
VOUSSOIR_INLINE void set_lane(T& number, [[maybe_unused]] int i, double value) {
  if constexpr (kLaneCount<T> == 1)
    number = value;
  else
    number[i] = value;
}

template <class T>
VOUSSOIR_INLINE T all_lanes(double value) {
  return T{} + value;
}

template <class T>
VOUSSOIR_INLINE T larger(T a, T b) {
  return a > b ? a : b;
}

template <class T>
VOUSSOIR_INLINE T smaller(T a, T b) {
  return a < b ? a : b;
}

template <class T>
VOUSSOIR_INLINE T magnitude(T a) {
  return a < 0.0 ? -a : a;
}

template <class T>
VOUSSOIR_INLINE T square_root(T a) {
  T root{};
  for (int i = 0; i < kLaneCount<T>; ++i) set_lane(root, i, __builtin_sqrt(lane(a, i)));
  return root;
}

/// 1 / sqrt(a) to round-off for a in [3, 4.2]; a is taken to the nearer end outside. Without roots and
/// quotients, which take longest of all.
template <class T>
VOUSSOIR_INLINE T inverse_root_near_four(T a) {
  const T bounded = smaller(larger(a, T{} + 3.0), T{} + 4.2);
  T root = 0.7999 - 0.0745 * bounded;  // within 0.2 %
  for (int i = 0; i < 3; ++i) root = root * (1.5 - 0.5 * bounded * root * root);
  return root;
}

/// True if the condition holds in some lane.
template <class Mask>
VOUSSOIR_INLINE bool any(const Mask& mask) {
  if constexpr (sizeof(Mask) <= sizeof(int)) {
    return static_cast<bool>(mask);
  } else {
    std::int64_t either = 0;
    for (std::size_t i = 0; i < sizeof(Mask) / sizeof(std::int64_t); ++i) either |= mask[i];
    return either != 0;
  }
}

/// A number by itself in memory. Aligned for the widest instruction set that any clone of a kernel may use,
/// which the compiler does not do when it compiles for the oldest.
template <class T>
struct alignas(sizeof(T)) Cell {
  T value;
};

/// A vector of the plane in every lane, aligned likewise.
template <class T>
struct alignas(sizeof(T)) Pair {
  T x;
  T y;
};

template <class T>
VOUSSOIR_INLINE Pair<T> operator+(const Pair<T>& a, const Pair<T>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class T>
VOUSSOIR_INLINE Pair<T> operator-(const Pair<T>& a, const Pair<T>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class T, class S>
VOUSSOIR_INLINE Pair<T> operator*(const Pair<T>& a, const S& factor) {
  return {a.x * factor, a.y * factor};
}
template <class T>
VOUSSOIR_INLINE T dot(const Pair<T>& a, const Pair<T>& b) {
  return a.x * b.x + a.y * b.y;
}

}  // namespace voussoir
