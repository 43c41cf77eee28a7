#pragma once
/// @file Products of many positive numbers, in the place of sums of their logarithms.

#include <cmath>
#include <numbers>

#include "core/simd/lanes.h"

namespace voussoir {

/// A positive number as mantissa times two to the power of the exponent: products of any length keep their
/// range.
struct WideProduct {
  double mantissa = 1.0;
  double exponent = 0.0;
};

/// So many factors within 1e+-19 of one cannot leave a double's range.
inline constexpr std::size_t kSafeProducts = 16;

/// Multiplies the lanes' products into the wide one and starts the lanes anew.
VOUSSOIR_INLINE void flush(DoubleLanes& product, WideProduct& wide) {
  constexpr std::int64_t kMantissaBits = 0x000FFFFFFFFFFFFF;
  constexpr std::int64_t kOneBits = 0x3FF0000000000000;
  const DoubleMask bits = reinterpret_cast<DoubleMask>(product);
  const DoubleMask exponents = (bits >> 52) - 1023;
  const DoubleLanes mantissas = reinterpret_cast<DoubleLanes>((bits & kMantissaBits) | kOneBits);
  wide.mantissa *= (mantissas[0] * mantissas[1]) * (mantissas[2] * mantissas[3]);
  wide.exponent += static_cast<double>((exponents[0] + exponents[1]) + (exponents[2] + exponents[3]));
  product = DoubleLanes{} + 1.0;
}

VOUSSOIR_INLINE double logarithm_of(const WideProduct& product) {
  return std::log(product.mantissa) + product.exponent * std::numbers::ln2;
}

}  // namespace voussoir
