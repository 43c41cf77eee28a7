#include "lookup/sketch_bounds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#ifdef __x86_64__
#define VOUSSOIR_HAS_AVX2
#include <immintrin.h>
#endif

#include "lookup/float_lanes.h"

namespace voussoir {
namespace {

constexpr std::size_t kStepsAtOnce = kSketchPlaces / kSideBySide;
constexpr std::size_t kStepsWithin = 64;  // sums of so many times four points stay within 16 bits

void append(unsigned within, const float* bounds, std::size_t first, std::vector<RowBound>& found) {
  for (; within != 0; within &= within - 1) {
    const auto row = static_cast<std::size_t>(std::countr_zero(within));
    found.push_back({static_cast<std::uint32_t>(first + row), bounds[row]});
  }
}

void plain_rows_within(const SketchCluster& cluster, std::span<const std::uint8_t> sides, float distance,
                       float limit, float reach, std::vector<RowBound>& found) {
  for (std::size_t row = 0; row < cluster.step.size(); ++row) {
    if (cluster.distance[row / kGroup * kGroup] < reach) return;
    const std::int8_t* const steps =
        cluster.steps + row / kGroup * kGroup * sides.size() + row % kGroup * kSideBySide;
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < sides.size(); ++i)
      sum += sides[i] * steps[i / kSideBySide * kSideBySide * kGroup + i % kSideBySide];
    const float bound = distance - cluster.step[row] * static_cast<float>(sum) + cluster.start[row];
    append(bound <= limit ? 1 : 0, &bound, row, found);
  }
}

void plain_sides(const float* readings, const float* centre, const std::uint8_t* above,
                 const std::uint8_t* no_reading, std::span<std::uint8_t> sides) {
  for (std::size_t i = 0; i < sides.size(); ++i)
    sides[i] = static_cast<std::uint8_t>((readings[i] > centre[i] ? above[i] : 0) | no_reading[i]);
}

#ifdef VOUSSOIR_HAS_AVX2
/// For each row of a group the sum of side * number of steps.
__attribute__((target("avx2"))) inline __m256i avx2_sums(const std::int8_t* steps,
                                                         std::span<const std::uint8_t> sides) {
  constexpr std::size_t kBytes = kSideBySide * kGroup;
  const std::size_t count = sides.size() / kSideBySide;
  __m256i sums = _mm256_setzero_si256();
  for (std::size_t first = 0; first < count; first += kStepsWithin) {
    __m256i even = _mm256_setzero_si256(), odd = even;
    const std::size_t last = std::min(count, first + kStepsWithin);
    for (std::size_t i = first; i < last; i += kStepsAtOnce) {
      const auto* const values = reinterpret_cast<const __m256i*>(steps + kBytes * i);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < kStepsAtOnce; ++k) {
        std::int32_t side;
        std::memcpy(&side, sides.data() + kSideBySide * (i + k), sizeof side);
        const __m256i product = _mm256_maddubs_epi16(_mm256_set1_epi32(side), _mm256_loadu_si256(values + k));
        __m256i& sum = k % 2 == 0 ? even : odd;
        sum = _mm256_add_epi16(sum, product);
      }
    }
    sums = _mm256_add_epi32(sums, _mm256_madd_epi16(even, _mm256_set1_epi16(1)));
    sums = _mm256_add_epi32(sums, _mm256_madd_epi16(odd, _mm256_set1_epi16(1)));
  }
  return sums;
}

__attribute__((target("avx2"))) void avx2_rows_within(const SketchCluster& cluster,
                                                      std::span<const std::uint8_t> sides, float distance,
                                                      float limit, float reach,
                                                      std::vector<RowBound>& found) {
  std::array<float, kGroup> bounds;
  for (std::size_t row = 0; row < cluster.step.size() && cluster.distance[row] >= reach; row += kGroup) {
    const __m256 sums = _mm256_cvtepi32_ps(avx2_sums(cluster.steps + row * sides.size(), sides));
    const __m256 change = _mm256_mul_ps(_mm256_loadu_ps(cluster.step.data() + row), sums);
    const __m256 bound = _mm256_add_ps(_mm256_sub_ps(_mm256_set1_ps(distance), change),
                                       _mm256_loadu_ps(cluster.start.data() + row));
    const int within = _mm256_movemask_ps(_mm256_cmp_ps(bound, _mm256_set1_ps(limit), _CMP_LE_OQ));
    if (within == 0) continue;
    _mm256_storeu_ps(bounds.data(), bound);
    append(static_cast<unsigned>(within), bounds.data(), row, found);
  }
}

__attribute__((target("avx2"))) void avx2_sides(const float* readings, const float* centre,
                                                const std::uint8_t* above, const std::uint8_t* no_reading,
                                                std::span<std::uint8_t> sides) {
  for (std::size_t i = 0; i < sides.size(); i += kSketchPlaces) {
    const auto is_above = [&](std::size_t at) __attribute__((target("avx2"))) {
      return _mm256_castps_si256(
          _mm256_cmp_ps(_mm256_loadu_ps(readings + at), _mm256_loadu_ps(centre + at), _CMP_GT_OQ));
    };
    const __m256i words = _mm256_permute4x64_epi64(_mm256_packs_epi32(is_above(i), is_above(i + 8)), 0xD8);
    const __m128i bytes = _mm_packs_epi16(_mm256_castsi256_si128(words), _mm256_extracti128_si256(words, 1));
    const auto load = [&](const std::uint8_t* from) __attribute__((target("avx2"))) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + i));
    };
    _mm_storeu_si128(reinterpret_cast<__m128i*>(sides.data() + i),
                     _mm_or_si128(_mm_and_si128(bytes, load(above)), load(no_reading)));
  }
}
#endif

VOUSSOIR_FOR_EVERY_PROCESSOR
void find_distances(const float* readings, const std::int32_t* is_read, const float* centres,
                    std::size_t count, std::size_t stride, float* distances) {
  for (std::size_t row = 0; row < count; ++row) {
    std::array<FloatLanes, kSketchPlaces / kFloatLanes> sums{};
    for (std::size_t first = 0; first < stride; first += kSketchPlaces)
      for (std::size_t part = 0; part < sums.size(); ++part) {
        const std::size_t i = first + part * kFloatLanes;
        FloatLanes reading, centre;
        FloatMask mask;
        load(readings + i, reading);
        load(centres + row * stride + i, centre);
        std::memcpy(&mask, is_read + i, sizeof mask);
        sums[part] += reinterpret_cast<FloatLanes>(reinterpret_cast<FloatMask>(reading - centre) & mask);
      }
    distances[row] = sum_of(sums[0] + sums[1]);
  }
}

}  // namespace

SketchReadings::SketchReadings(std::span<const double> readings)
    : reading_((readings.size() + kSketchPlaces - 1) / kSketchPlaces * kSketchPlaces, 0.0F),
      is_read_(reading_.size(), 0),
      above_(reading_.size(), 0),
      no_reading_(reading_.size(), 1),
      sides_(reading_.size()) {
  double rounding = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (std::isnan(readings[i])) continue;
    reading_[i] = static_cast<float>(readings[i]);
    is_read_[i] = INT32_MAX;
    above_[i] = 2;
    no_reading_[i] = 0;
    rounding += std::abs(readings[i] - static_cast<double>(reading_[i]));
  }
  rounding_ = std::nextafter(static_cast<float>(rounding), std::numeric_limits<float>::infinity());
}

std::vector<float> SketchReadings::distances(std::span<const float> centres) const {
  std::vector<float> result(centres.size() / reading_.size());
  find_distances(reading_.data(), is_read_.data(), centres.data(), result.size(), reading_.size(),
                 result.data());
  return result;
}

std::span<const std::uint8_t> SketchReadings::sides(std::span<const float> centre) {
#ifdef VOUSSOIR_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) {
    avx2_sides(reading_.data(), centre.data(), above_.data(), no_reading_.data(), sides_);
    return sides_;
  }
#endif
  plain_sides(reading_.data(), centre.data(), above_.data(), no_reading_.data(), sides_);
  return sides_;
}

void append_rows_within(const SketchCluster& cluster, SketchReadings& readings, std::span<const float> centre,
                        float distance, float limit, std::vector<RowBound>& found) {
  const float start = readings.least(distance);
  const float reach = (start - limit) * kRoundedDown;
  const auto sides = readings.sides(centre);
#ifdef VOUSSOIR_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) return avx2_rows_within(cluster, sides, start, limit, reach, found);
#endif
  plain_rows_within(cluster, sides, start, limit, reach, found);
}

}  // namespace voussoir
