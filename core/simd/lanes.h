#pragma once
/// @file Scenes side by side: one value of each of several scenes in neighbouring memory.

#include <array>
#include <cstddef>
#include <vector>

/// Compiles a function twice, for processors with and without AVX2, and picks at start-up. Without
/// contraction to fused operations (the whole project is compiled so) both give the same bits. Not under
/// sanitizers, whose run-time is not ready when the choice is made.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__x86_64__)
#define VOUSSOIR_FOR_EVERY_PROCESSOR
#else
#define VOUSSOIR_FOR_EVERY_PROCESSOR __attribute__((target_clones("avx2", "default")))
#endif

namespace voussoir {

/// Scenes side by side: four doubles are one AVX register.
inline constexpr std::size_t kLanes = 4;

/// One value per lane.
using LaneValue = std::array<double, kLanes>;

/// Values of all lanes: entry i of lane l is `[i][l]`.
using LaneVector = std::vector<LaneValue>;

/// What kernels read and write LaneValues as: one register, at any address.
using LaneRegister =
    double __attribute__((vector_size(kLanes * sizeof(double)), aligned(sizeof(double)), may_alias));

inline LaneRegister* registers(LaneVector& values) {
  return reinterpret_cast<LaneRegister*>(values.data());
}

inline const LaneRegister* registers(const LaneVector& values) {
  return reinterpret_cast<const LaneRegister*>(values.data());
}

}  // namespace voussoir
