#pragma once
/// @file Arithmetic on kLanes doubles side by side, with NaN for what is not there.

#include <cstdint>
#include <cstring>

#include "core/simd/lanes.h"

namespace voussoir {

#define VOUSSOIR_INLINE inline __attribute__((always_inline))

using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using LaneMask = std::int64_t __attribute__((vector_size(kLanes * sizeof(double))));

VOUSSOIR_INLINE void load(const double* from, Lanes& lanes) {
  std::memcpy(&lanes, from, sizeof(Lanes));
}

/// The first `count` (less than kLanes) values, NaN behind them.
VOUSSOIR_INLINE void load_some(const double* from, std::size_t count, Lanes& lanes) {
  lanes = Lanes{} + __builtin_nan("");
  for (std::size_t i = 0; i < count; ++i) lanes[i] = from[i];
}

/// The first `count` (at most kLanes) lanes.
VOUSSOIR_INLINE void store(const Lanes& lanes, double* to, std::size_t count) {
  std::memcpy(to, &lanes, count * sizeof(double));
}

/// lanes = |lanes|
VOUSSOIR_INLINE void make_absolute(Lanes& lanes) {
  lanes = reinterpret_cast<Lanes>(reinterpret_cast<LaneMask>(lanes) & INT64_MAX);
}

}  // namespace voussoir
