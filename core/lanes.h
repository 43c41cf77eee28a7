#pragma once
/// @file Numbers that are one double, or several side by side, one for each scene of a group.
///
/// Kernels are templates on such a number. Conditions are masks (bool, or one for each lane), `mask ? a : b` picks
/// lane by lane, and no operation mixes lanes: a lane's bits do not depend on what the other lanes hold.

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
  if constexpr (kLaneCount<T> == 1) {
    return __builtin_sqrt(a);
  } else {
    T root;
    for (int i = 0; i < kLaneCount<T>; ++i) root[i] = __builtin_sqrt(a[i]);
    return root;
  }
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

/// A vector of the plane in every lane.
template <class T>
struct Pair {
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
