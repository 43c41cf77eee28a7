#pragma once
/// @file Eight floats side by side.

#include "lookup/lanes.h"

namespace voussoir {

inline constexpr std::size_t kFloatLanes = 8;
using FloatLanes = float __attribute__((vector_size(kFloatLanes * sizeof(float))));
using FloatMask = std::int32_t __attribute__((vector_size(kFloatLanes * sizeof(float))));

VOUSSOIR_INLINE void load(const float* from, FloatLanes& lanes) {
  std::memcpy(&lanes, from, sizeof(FloatLanes));
}

/// lanes = |lanes|
VOUSSOIR_INLINE void make_absolute(FloatLanes& lanes) {
  lanes = reinterpret_cast<FloatLanes>(reinterpret_cast<FloatMask>(lanes) & INT32_MAX);
}

VOUSSOIR_INLINE float sum_of(const FloatLanes& lanes) {
  using HalfLanes = float __attribute__((vector_size(sizeof(FloatLanes) / 2)));
  HalfLanes low, high;
  std::memcpy(&low, &lanes, sizeof low);
  std::memcpy(&high, reinterpret_cast<const char*>(&lanes) + sizeof low, sizeof high);
  low += high;
  return (low[0] + low[2]) + (low[1] + low[3]);
}

}  // namespace voussoir
