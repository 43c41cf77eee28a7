#pragma once
/// @file A vector of the plane in every lane.

#include "core/simd/lanes.h"

namespace voussoir {

/// Aligned like a Cell.
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
VOUSSOIR_INLINE void set_pair(Pair<T>& pair, int i, double x, double y) {
  set_lane(pair.x, i, x);
  set_lane(pair.y, i, y);
}
template <class T>
VOUSSOIR_INLINE T dot(const Pair<T>& a, const Pair<T>& b) {
  return a.x * b.x + a.y * b.y;
}

}  // namespace voussoir
