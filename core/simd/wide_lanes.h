#pragma once
/// @file Registers of twice as many doubles, where the processor has them (AVX-512). Without contraction to
/// fused operations each lane has the bits of DoubleLanes.

#include "core/simd/lanes.h"

namespace voussoir {

using WideLanes = LanesOf<double, 2 * kLanes>::Type;

/// A function marked so may only be called where has_wide_registers() is true; the compiler makes of wide
/// lanes something much slower for other processors.
#ifdef __x86_64__
#define VOUSSOIR_WIDE __attribute__((target("avx512f")))
inline bool has_wide_registers() {
  return __builtin_cpu_supports("avx512f") != 0;
}
#else
#define VOUSSOIR_WIDE
inline bool has_wide_registers() {
  return false;
}
#endif

}  // namespace voussoir
