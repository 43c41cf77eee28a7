#pragma once
/// @file Eight floats side by side.

#include "core/simd/lane_arithmetic.h"

namespace voussoir {

inline constexpr std::size_t kFloatLanes = 8;
using FloatLanes = float __attribute__((vector_size(kFloatLanes * sizeof(float))));
using FloatMask = std::int32_t __attribute__((vector_size(kFloatLanes * sizeof(float))));

VOUSSOIR_INLINE void load(const float* from, FloatLanes& lanes) {
  std::memcpy(&lanes, from, sizeof(FloatLanes));
}

VOUSSOIR_INLINE void load(const double* from, FloatLanes& lanes) {
  using DoubleLanes = double __attribute__((vector_size(kFloatLanes * sizeof(double))));
  DoubleLanes doubles;
  std::memcpy(&doubles, from, sizeof doubles);
  lanes = __builtin_convertvector(doubles, FloatLanes);
}

VOUSSOIR_INLINE void load(const std::int16_t* from, FloatLanes& lanes) {
  using ShortLanes = std::int16_t __attribute__((vector_size(kFloatLanes * sizeof(std::int16_t))));
  ShortLanes shorts;
  std::memcpy(&shorts, from, sizeof shorts);
  lanes = __builtin_convertvector(shorts, FloatLanes);
}

/// lanes = |lanes|
VOUSSOIR_INLINE void make_absolute(FloatLanes& lanes) {
  lanes = reinterpret_cast<FloatLanes>(reinterpret_cast<FloatMask>(lanes) & INT32_MAX);
}

/// The first `size` lanes.
VOUSSOIR_INLINE void load_some(const float* from, std::size_t size, FloatLanes& lanes) {
  if (size == kFloatLanes) return load(from, lanes);
  for (std::size_t i = 0; i < size; ++i) lanes[i] = from[i];
}
VOUSSOIR_INLINE void store_some(const FloatLanes& lanes, std::size_t size, float* to) {
  std::memcpy(to, &lanes, size == kFloatLanes ? sizeof lanes : size * sizeof(float));
}

/// x = log(x) within 1e-5 for positive normal numbers; anything for others.
VOUSSOIR_INLINE void make_approximate_logarithm(FloatLanes& x) {
  constexpr float kLog2 = 0.69314718F;
  constexpr std::int32_t kRootHalfBits = 0x3F3504F3;
  const FloatMask bits = reinterpret_cast<FloatMask>(x);
  const FloatMask exponent = (bits - kRootHalfBits) >> 23;  // x = 2^exponent f with f in [sqrt(1/2), sqrt(2))
  const FloatLanes f = reinterpret_cast<FloatLanes>(bits - (exponent << 23));
  const FloatLanes s = (f - 1.0F) / (f + 1.0F);
  const FloatLanes q = s * s;
  x = __builtin_convertvector(exponent, FloatLanes) * kLog2 +
      2.0F * s * (1.0F + q * (1.0F / 3.0F + q * (1.0F / 5.0F)));
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
