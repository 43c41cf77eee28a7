#pragma once
/// @file Four doubles side by side, and the attribute that compiles a loop over them for the newest common
/// instruction set as well as for the oldest; both give the same bits (no contraction, the same order of
/// sums).

#include <cstdint>
#include <cstring>

namespace voussoir {

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__clang__)
#define VOUSSOIR_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define VOUSSOIR_VECTORISED
#endif
#define VOUSSOIR_INLINE inline __attribute__((always_inline))

inline constexpr std::size_t kLanes = 4;
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
