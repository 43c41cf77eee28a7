#pragma once
/// @file Whole numbers of 16 bits side by side, with what AVX2 has for them and the compiler does not find by
/// itself. Functions marked VOUSSOIR_AVX2 may only be called by such functions, or where has_avx2() is true.

#include "core/simd/lanes.h"

#ifdef __x86_64__
#include <immintrin.h>

#define VOUSSOIR_HAS_AVX2
#define VOUSSOIR_AVX2 __attribute__((target("avx2")))

namespace voussoir {

inline constexpr std::size_t kShortLanes = 16;
using ShortLanes = LanesOf<std::int16_t, kShortLanes>::Type;
using IntLanes = LanesOf<std::int32_t, kShortLanes / 2>::Type;
using FourInts = LanesOf<std::int32_t, 4>::Type;
using FourUnsigned = LanesOf<std::uint32_t, 4>::Type;

inline constexpr std::size_t kByteLanes = 32;
using ByteLanes = LanesOf<std::int8_t, kByteLanes>::Type;
using UnsignedByteLanes = LanesOf<std::uint8_t, kByteLanes>::Type;
using HalfByteLanes = LanesOf<std::int8_t, kByteLanes / 2>::Type;
using UnsignedHalfByteLanes = LanesOf<std::uint8_t, kByteLanes / 2>::Type;

inline bool has_avx2() {
  return __builtin_cpu_supports("avx2");
}

/// |a|
VOUSSOIR_AVX2 inline ShortLanes magnitude(ShortLanes a) {
  return reinterpret_cast<ShortLanes>(_mm256_abs_epi16(reinterpret_cast<__m256i>(a)));
}

/// The products of two neighbours, added.
VOUSSOIR_AVX2 inline IntLanes paired_products(ShortLanes a, ShortLanes b) {
  return reinterpret_cast<IntLanes>(
      _mm256_madd_epi16(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
}
VOUSSOIR_AVX2 inline ShortLanes paired_products(UnsignedByteLanes a, ByteLanes b) {
  return reinterpret_cast<ShortLanes>(
      _mm256_maddubs_epi16(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
}
/// The same for half as many, with zeros behind them.
VOUSSOIR_AVX2 inline ShortLanes paired_products(UnsignedHalfByteLanes a, HalfByteLanes b) {
  return reinterpret_cast<ShortLanes>(
      _mm256_zextsi128_si256(_mm_maddubs_epi16(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b))));
}

/// Two neighbours added: those of a, then those of b, in each half of the register.
VOUSSOIR_AVX2 inline IntLanes paired_sums(IntLanes a, IntLanes b) {
  return reinterpret_cast<IntLanes>(
      _mm256_hadd_epi32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
}

/// The sum of all lanes, for each of four.
VOUSSOIR_AVX2 inline FourInts sums_of(const IntLanes (&lanes)[4]) {
  const IntLanes sums = paired_sums(paired_sums(lanes[0], lanes[1]), paired_sums(lanes[2], lanes[3]));
  const auto bits = reinterpret_cast<__m256i>(sums);
  return reinterpret_cast<FourInts>(_mm256_castsi256_si128(bits)) +
         reinterpret_cast<FourInts>(_mm256_extracti128_si256(bits, 1));
}

/// Numbers from 0 to 255 as bytes.
VOUSSOIR_AVX2 inline void store_as_bytes(ShortLanes numbers, std::uint8_t* to) {
  const auto bits = reinterpret_cast<__m256i>(numbers);
  const __m128i bytes = _mm_packus_epi16(_mm256_castsi256_si128(bits), _mm256_extracti128_si256(bits, 1));
  std::memcpy(to, &bytes, sizeof bytes);
}

/// A bit for each lane of a mask, the first lane's lowest.
VOUSSOIR_AVX2 inline unsigned bits_of(FourInts mask) {
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
}

}  // namespace voussoir
#endif
