#pragma once
/// @file Logarithm and exponential of lanes, in plain arithmetic: the same bits on every machine.

#include <cstdint>
#include <limits>
#include <span>

#include "core/simd/lanes.h"

namespace voussoir {

/// x = log(x) for normal positive numbers, within 2 units in the last place of the larger of result and 1;
/// -infinity for zero, subnormal and negative numbers; infinity and NaN stay.
///
/// x = 2^e f with f in [sqrt(1/2), sqrt(2)); log f = 2 atanh(s) with s = (f - 1) / (f + 1), |s| < 0.1716, by
/// its odd series up to s^19 (the next term is below 1e-17).
VOUSSOIR_INLINE void make_logarithm(DoubleLanes& x) {
  using Bits = LanesOf<std::uint64_t, kLanes>::Type;  // of negative numbers, signed ones would overflow
  constexpr std::uint64_t kRootHalfBits = 0x3FE6A09E667F3BCD;
  constexpr std::uint64_t kExponentMask = 0xFFF0000000000000;
  const Bits bits = reinterpret_cast<Bits>(x);
  const Bits shifted = (bits - kRootHalfBits) & kExponentMask;
  const DoubleLanes f = reinterpret_cast<DoubleLanes>(bits - shifted);
  const DoubleLanes e = __builtin_convertvector(reinterpret_cast<DoubleMask>(shifted) >> 52, DoubleLanes);
  const DoubleLanes s = (f - 1.0) / (f + 1.0);
  const DoubleLanes q = s * s;
  DoubleLanes series = DoubleLanes{} + 1.0 / 19.0;
  for (const double divisor : {17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0})
    series = series * q + 1.0 / divisor;
  const DoubleLanes tail = s * q * series;
  constexpr double kLn2High = 0x1.62e42fefa3800p-1;  // the last bits are zero: e times it is exact
  constexpr double kLn2Low = 0x1.ef35793c76730p-45;
  const DoubleLanes result = e * kLn2High + (2.0 * s + (2.0 * tail + e * kLn2Low));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const DoubleLanes special =
      x < kInfinity ? DoubleLanes{} - kInfinity : x;  // comparisons with NaN are false: NaN stays
  x = (x >= std::numeric_limits<double>::min()) & (x < kInfinity) ? result : special;
}

/// x = exp(x) for x <= 0, within 3 units in the last place; zero below -708, NaN stays.
///
/// x = k log 2 + r with |r| <= log(2) / 2; exp r by its Taylor polynomial of degree 13 (remainder below
/// 1e-17).
VOUSSOIR_INLINE void make_exponential(DoubleLanes& x) {
  constexpr double kLowest = -708.0;
  constexpr double kRound = 0x1.8p52;  // adding it leaves the nearest whole number in the low bits
  constexpr double kLn2High = 0x1.62e42fefa3800p-1;
  constexpr double kLn2Low = 0x1.ef35793c76730p-45;
  const DoubleLanes bounded = x > kLowest ? x : DoubleLanes{} + kLowest;
  const DoubleLanes rounded = bounded * 0x1.71547652b82fep0 + kRound;
  const DoubleLanes k = rounded - kRound;
  const DoubleLanes r = (bounded - k * kLn2High) - k * kLn2Low;
  DoubleLanes series = DoubleLanes{} + 1.0 / 6227020800.0;
  for (const double factorial : {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0, 720.0, 120.0,
                                 24.0, 6.0, 2.0, 1.0, 1.0})
    series = series * r + 1.0 / factorial;
  const DoubleMask scale = (__builtin_convertvector(k, DoubleMask) + 1023) << 52;
  const DoubleLanes result = series * reinterpret_cast<DoubleLanes>(scale);
  const DoubleLanes special = x <= kLowest ? DoubleLanes{} : x;
  x = x > kLowest ? result : special;
}

/// x = log(x) for normal positive floats, within 2 units in the last place of the larger of result and 1;
/// what other numbers become is not said. The series goes up to s^7 (the next term is below 4e-8).
VOUSSOIR_INLINE void make_logarithm(FloatLanes& x) {
  using Bits = LanesOf<std::uint32_t, kFloatLanes>::Type;
  constexpr std::uint32_t kRootHalfBits = 0x3F3504F3;
  constexpr std::uint32_t kExponentMask = 0xFF800000;
  const Bits bits = reinterpret_cast<Bits>(x);
  const Bits shifted = (bits - kRootHalfBits) & kExponentMask;
  const FloatLanes f = reinterpret_cast<FloatLanes>(bits - shifted);
  const FloatLanes e = __builtin_convertvector(reinterpret_cast<FloatMask>(shifted) >> 23, FloatLanes);
  const FloatLanes s = (f - 1.0f) / (f + 1.0f);
  const FloatLanes q = s * s;
  const FloatLanes series = (1.0f / 7.0f * q + 1.0f / 5.0f) * q + 1.0f / 3.0f;
  constexpr float kLn2High = 0.693359375f;  // nine bits: e times it is exact
  constexpr float kLn2Low = -2.12194440e-4f;
  x = e * kLn2High + (2.0f * s + (2.0f * (s * q * series) + e * kLn2Low));
}

/// x = exp(x) for floats x <= 0, within 3 units in the last place; zero below -87, NaN stays. The polynomial
/// is of degree 7 (remainder below 6e-9).
VOUSSOIR_INLINE void make_exponential(FloatLanes& x) {
  constexpr float kLowest = -87.0f;
  constexpr float kRound = 0x1.8p23f;
  constexpr float kLn2High = 0.693359375f;
  constexpr float kLn2Low = -2.12194440e-4f;
  const FloatLanes bounded = x > kLowest ? x : FloatLanes{} + kLowest;
  const FloatLanes rounded = bounded * 0x1.715476p0f + kRound;
  const FloatLanes k = rounded - kRound;
  const FloatLanes r = (bounded - k * kLn2High) - k * kLn2Low;
  FloatLanes series = FloatLanes{} + 1.0f / 5040.0f;
  for (const float factorial : {720.0f, 120.0f, 24.0f, 6.0f, 2.0f, 1.0f, 1.0f})
    series = series * r + 1.0f / factorial;
  const FloatMask scale = (__builtin_convertvector(k, FloatMask) + 127) << 23;
  const FloatLanes result = series * reinterpret_cast<FloatLanes>(scale);
  const FloatLanes special = x <= kLowest ? FloatLanes{} : x;
  x = x > kLowest ? result : special;
}

/// Of doubles, for arrays: each value becomes its logarithm, its exponential.
void make_logarithms(std::span<double> values);
void make_exponentials(std::span<double> values);

}  // namespace voussoir
