#pragma once
/// @file Logarithm and exponential of four doubles at once, in plain arithmetic: the same bits on every
/// machine.

#include <cstdint>
#include <limits>
#include <span>

#include "core/simd/lane_arithmetic.h"

namespace voussoir {

/// x = log(x) for normal positive numbers, within 2 units in the last place of the larger of result and 1;
/// -infinity for zero, subnormal and negative numbers; infinity and NaN stay.
///
/// x = 2^e f with f in [sqrt(1/2), sqrt(2)); log f = 2 atanh(s) with s = (f - 1) / (f + 1), |s| < 0.1716, by
/// its odd series up to s^19 (the next term is below 1e-17).
VOUSSOIR_INLINE void make_logarithm(Lanes& x) {
  constexpr std::int64_t kRootHalfBits = 0x3FE6A09E667F3BCD;
  constexpr std::int64_t kExponentMask = static_cast<std::int64_t>(0xFFF0000000000000);
  const LaneMask bits = reinterpret_cast<LaneMask>(x);
  const LaneMask shifted = (bits - kRootHalfBits) & kExponentMask;
  const Lanes f = reinterpret_cast<Lanes>(bits - shifted);
  const Lanes e = __builtin_convertvector(shifted >> 52, Lanes);
  const Lanes s = (f - 1.0) / (f + 1.0);
  const Lanes q = s * s;
  Lanes series = Lanes{} + 1.0 / 19.0;
  for (const double divisor : {17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0})
    series = series * q + 1.0 / divisor;
  const Lanes tail = s * q * series;
  constexpr double kLn2High = 0x1.62e42fefa3800p-1;  // the last bits are zero: e times it is exact
  constexpr double kLn2Low = 0x1.ef35793c76730p-45;
  const Lanes result = e * kLn2High + (2.0 * s + (2.0 * tail + e * kLn2Low));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Lanes special = x < kInfinity ? Lanes{} - kInfinity : x;  // comparisons with NaN are false: NaN stays
  x = (x >= std::numeric_limits<double>::min()) & (x < kInfinity) ? result : special;
}

/// x = exp(x) for x <= 0, within 3 units in the last place; zero below -708, NaN stays.
///
/// x = k log 2 + r with |r| <= log(2) / 2; exp r by its Taylor polynomial of degree 13 (remainder below
/// 1e-17).
VOUSSOIR_INLINE void make_exponential(Lanes& x) {
  constexpr double kLowest = -708.0;
  constexpr double kRound = 0x1.8p52;  // adding it leaves the nearest whole number in the low bits
  constexpr double kLn2High = 0x1.62e42fefa3800p-1;
  constexpr double kLn2Low = 0x1.ef35793c76730p-45;
  const Lanes bounded = x > kLowest ? x : Lanes{} + kLowest;
  const Lanes rounded = bounded * 0x1.71547652b82fep0 + kRound;
  const Lanes k = rounded - kRound;
  const Lanes r = (bounded - k * kLn2High) - k * kLn2Low;
  Lanes series = Lanes{} + 1.0 / 6227020800.0;
  for (const double factorial : {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0, 720.0, 120.0,
                                 24.0, 6.0, 2.0, 1.0, 1.0})
    series = series * r + 1.0 / factorial;
  const LaneMask scale = (__builtin_convertvector(k, LaneMask) + 1023) << 52;
  const Lanes result = series * reinterpret_cast<Lanes>(scale);
  const Lanes special = x <= kLowest ? Lanes{} : x;
  x = x > kLowest ? result : special;
}

/// The same for arrays: each value becomes its logarithm, its exponential.
void make_logarithms(std::span<double> values);
void make_exponentials(std::span<double> values);

}  // namespace voussoir
