#include "lookup/search/index_bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#ifdef __x86_64__
#define VOUSSOIR_HAS_AVX2
#define VOUSSOIR_AVX2 __attribute__((target("avx2")))
#include <immintrin.h>
#endif

namespace voussoir {
namespace {

constexpr std::int32_t kCutOff = kFarthestPlace + 1;  // readings beyond all boxes stay beyond them

void plain_distances(const UnitReadings& readings, std::span<const std::int16_t> centres,
                     std::span<std::int32_t> distances) {
  const std::size_t places = readings.reading.size();
  for (std::size_t cluster = 0; cluster < distances.size(); ++cluster) {
    distances[cluster] = -readings.rounded;
    for (std::size_t i = 0; i < places; ++i)
      distances[cluster] +=
          std::abs(readings.reading[i] - centres[cluster * places + i]) * readings.is_read[i];
  }
}

void plain_sides(std::span<const std::int16_t> centre, const UnitReadings& readings,
                 std::span<std::uint8_t> sides) {
  for (std::size_t i = 0; i < sides.size(); ++i)
    sides[i] = readings.is_read[i] == 0 ? 1 : readings.reading[i] > centre[i] ? 2 : 0;
}

/// Writes the slots of those of some rows that lie at least `reach` from the cluster's centre and may be
/// nearer to the readings than it by `room` or more; gives how many. May write others whose distance is less.
std::size_t plain_within(const SearchIndex& index, std::size_t first, std::size_t rows,
                         std::span<const std::uint8_t> sides, std::int32_t reach, std::int32_t room,
                         std::uint32_t* found) {
  std::size_t count = 0;
  for (std::size_t slot = first; slot < first + rows && index.bounds[slot].distance() >= reach; ++slot) {
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) sum += sides[i] * index.sketch[slot * sides.size() + i];
    found[count] = static_cast<std::uint32_t>(slot);
    count += index.bounds[slot].step() * sum + index.bounds[slot].start >= room ? 1 : 0;
  }
  return count;
}

/// A sketched row against the readings: sum |reading - centre - step sketch|, and the sum of the sketch.
struct SketchSums {
  std::int32_t apart, sketch;
};
SketchSums plain_sketch_sums(const UnitReadings& readings, const std::int16_t* centre,
                             const std::int8_t* sketch, std::int32_t step) {
  SketchSums sums{0, 0};
  for (std::size_t i = 0; i < readings.reading.size(); ++i) {
    sums.apart += std::abs(readings.reading[i] - centre[i] - step * sketch[i]) * readings.is_read[i];
    sums.sketch += sketch[i];
  }
  return sums;
}

#ifdef VOUSSOIR_HAS_AVX2
constexpr std::size_t kMostPlaces = 2000;
constexpr std::size_t kCommonPlaces = 80;  // of the reference bridge
constexpr std::size_t kAbreast = 4;        // rows whose sums are worked out together
constexpr std::size_t kShorts = 16;        // numbers of 16 bits in a register

VOUSSOIR_AVX2 inline __m256i load(const void* from) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}
VOUSSOIR_AVX2 inline __m128i load_half(const void* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(from));
}

/// The sum of each register's eight numbers, for four registers.
VOUSSOIR_AVX2 inline __m128i sums_of(const __m256i (&lanes)[kAbreast]) {
  const __m256i sums =
      _mm256_hadd_epi32(_mm256_hadd_epi32(lanes[0], lanes[1]), _mm256_hadd_epi32(lanes[2], lanes[3]));
  return _mm_add_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
}

/// Adds sum |reading - row| over kShorts places.
VOUSSOIR_AVX2 inline void add_apart(__m256i reading, __m256i is_read, __m256i row, __m256i& sum) {
  sum = _mm256_add_epi32(sum, _mm256_madd_epi16(_mm256_abs_epi16(_mm256_sub_epi16(reading, row)), is_read));
}

/// As plain_distances, for at least kAbreast. kPlaces, here and below: of a row if known when compiled, else
/// 0.
template <std::size_t kPlaces>
VOUSSOIR_AVX2 void avx2_distances(const UnitReadings& readings, std::span<const std::int16_t> centres,
                                  std::span<std::int32_t> distances) {
  const std::size_t places = kPlaces != 0 ? kPlaces : readings.reading.size();
  const __m128i rounded = _mm_set1_epi32(readings.rounded);
  for (std::size_t next = 0; next < distances.size(); next += kAbreast) {
    const std::size_t cluster = std::min(next, distances.size() - kAbreast);  // the last ones perhaps twice
    const std::int16_t* const first = centres.data() + cluster * places;
    __m256i sums[kAbreast] = {};
    for (std::size_t i = 0; i < places; i += kShorts) {
      const __m256i reading = load(readings.reading.data() + i), is_read = load(readings.is_read.data() + i);
      for (std::size_t row = 0; row < kAbreast; ++row)
        add_apart(reading, is_read, load(first + row * places + i), sums[row]);
    }
    _mm_storeu_si128(reinterpret_cast<__m128i*>(distances.data() + cluster),
                     _mm_sub_epi32(sums_of(sums), rounded));
  }
}

template <std::size_t kPlaces>
VOUSSOIR_AVX2 void avx2_sides(std::span<const std::int16_t> centre, const UnitReadings& readings,
                              std::span<std::uint8_t> sides) {
  const std::size_t places = kPlaces != 0 ? kPlaces : sides.size();
  const __m256i one = _mm256_set1_epi16(1);
  for (std::size_t i = 0; i < places; i += kShorts) {
    const __m256i above = _mm256_cmpgt_epi16(load(readings.reading.data() + i), load(centre.data() + i));
    // above | 1 is -1 above and 1 elsewhere
    const __m256i side = _mm256_sub_epi16(
        one, _mm256_sign_epi16(_mm256_or_si256(above, one), load(readings.is_read.data() + i)));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(sides.data() + i),
                     _mm_packs_epi16(_mm256_castsi256_si128(side), _mm256_extracti128_si256(side, 1)));
  }
}

/// For kAbreast rows the sums of side * sketch. Each product adds 2 * 2 * 127 to a number of 16 bits at most,
/// so that rows of up to kMostPlaces are safe.
VOUSSOIR_AVX2 inline __attribute__((always_inline)) __m128i avx2_sums(const std::int8_t* sketch,
                                                                      const std::uint8_t* sides,
                                                                      std::size_t places) {
  const std::size_t paired = places / 32 * 32;
  const std::int8_t *second = sketch + places, *third = second + places, *fourth = third + places;
  __m256i a = _mm256_setzero_si256(), b = a, c = a, d = a;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < paired; i += 32) {
    const __m256i side = load(sides + i);
    a = _mm256_add_epi16(a, _mm256_maddubs_epi16(side, load(sketch + i)));
    b = _mm256_add_epi16(b, _mm256_maddubs_epi16(side, load(second + i)));
    c = _mm256_add_epi16(c, _mm256_maddubs_epi16(side, load(third + i)));
    d = _mm256_add_epi16(d, _mm256_maddubs_epi16(side, load(fourth + i)));
  }
  if (paired < places) {
    const __m128i side = load_half(sides + paired);
    a = _mm256_add_epi16(a, _mm256_zextsi128_si256(_mm_maddubs_epi16(side, load_half(sketch + paired))));
    b = _mm256_add_epi16(b, _mm256_zextsi128_si256(_mm_maddubs_epi16(side, load_half(second + paired))));
    c = _mm256_add_epi16(c, _mm256_zextsi128_si256(_mm_maddubs_epi16(side, load_half(third + paired))));
    d = _mm256_add_epi16(d, _mm256_zextsi128_si256(_mm_maddubs_epi16(side, load_half(fourth + paired))));
  }
  const __m256i one = _mm256_set1_epi16(1);
  const __m256i sums[kAbreast] = {_mm256_madd_epi16(a, one), _mm256_madd_epi16(b, one),
                                  _mm256_madd_epi16(c, one), _mm256_madd_epi16(d, one)};
  return sums_of(sums);
}

/// SlotBounds of kAbreast rows, member by member.
struct FourBounds {
  __m128i distance_and_step, start;
};
VOUSSOIR_AVX2 inline FourBounds four_bounds(const SlotBounds* from) {
  const __m128 first = _mm_castsi128_ps(load_half(from)), second = _mm_castsi128_ps(load_half(from + 2));
  return {_mm_castps_si128(_mm_shuffle_ps(first, second, 0x88)),
          _mm_castps_si128(_mm_shuffle_ps(first, second, 0xDD))};
}

/// As plain_within; looks at up to three rows more.
template <std::size_t kPlaces>
VOUSSOIR_AVX2 std::size_t avx2_within(const SearchIndex& index, std::size_t first, std::size_t rows,
                                      std::span<const std::uint8_t> sides, std::int32_t reach,
                                      std::int32_t room, std::uint32_t* found) {
  const std::size_t places = kPlaces != 0 ? kPlaces : sides.size();
  const std::int8_t* sketch = index.sketch.data() + first * places;
  const SlotBounds* from = index.bounds.data() + first;
  std::size_t count = 0;
  const __m128i enough = _mm_set1_epi32(room);
  for (std::size_t row = 0; row < rows; row += kAbreast, sketch += kAbreast * places, from += kAbreast) {
    if (from->distance() < reach) break;
    const __m128i sums = avx2_sums(sketch, sides.data(), places);
    const FourBounds bounds = four_bounds(from);
    const __m128i nearer =
        _mm_add_epi32(_mm_mullo_epi32(sums, _mm_srli_epi32(bounds.distance_and_step, 16)), bounds.start);
    auto within =
        ~static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(_mm_cmpgt_epi32(enough, nearer)))) & 0xFU;
    for (; within != 0; within &= within - 1) {
      const std::size_t member = row + static_cast<std::size_t>(std::countr_zero(within));
      found[count] = static_cast<std::uint32_t>(first + member);
      count += member < rows ? 1 : 0;
    }
  }
  return count;
}

VOUSSOIR_AVX2 SketchSums avx2_sketch_sums(const UnitReadings& readings, const std::int16_t* centre,
                                          const std::int8_t* sketch, std::int32_t step) {
  const __m256i steps = _mm256_set1_epi16(static_cast<std::int16_t>(step)), one = _mm256_set1_epi16(1);
  __m256i sums[kAbreast] = {};
  for (std::size_t i = 0; i < readings.reading.size(); i += kShorts) {
    const __m256i row = _mm256_cvtepi8_epi16(load_half(sketch + i));
    add_apart(load(readings.reading.data() + i), load(readings.is_read.data() + i),
              _mm256_add_epi16(load(centre + i), _mm256_mullo_epi16(row, steps)), sums[0]);
    sums[1] = _mm256_add_epi32(sums[1], _mm256_madd_epi16(row, one));
  }
  const __m128i both = sums_of(sums);
  return {_mm_cvtsi128_si32(both), _mm_extract_epi32(both, 1)};
}

bool use_avx2() {
  return __builtin_cpu_supports("avx2");
}
#endif

SketchSums sketch_sums(const UnitReadings& readings, const std::int16_t* centre, const std::int8_t* sketch,
                       std::int32_t step) {
#ifdef VOUSSOIR_HAS_AVX2
  if (use_avx2()) return avx2_sketch_sums(readings, centre, sketch, step);
#endif
  return plain_sketch_sums(readings, centre, sketch, step);
}

}  // namespace

UnitReadings round_readings(std::span<const double> readings, std::size_t places, int exponent) {
  UnitReadings result{std::vector<std::int16_t>(places, 0), std::vector<std::int16_t>(places, 0)};
  const double units = std::ldexp(1.0, -exponent);
  double rounded = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const bool is_read = !std::isnan(readings[i]);
    const double exact = is_read ? readings[i] * units : 0.0;
    const double inside = std::clamp(exact, -double{kCutOff}, double{kCutOff});
    const auto whole = static_cast<std::int32_t>(inside + (inside < 0.0 ? -0.5 : 0.5));
    // What is cut off lies beyond the centre and the rows: it would only add to their sums.
    result.is_cut_off |= inside != exact;
    rounded += std::abs(inside - whole);
    result.reading[i] = static_cast<std::int16_t>(whole);
    result.is_read[i] = is_read ? 1 : 0;
  }
  result.rounded = static_cast<std::int32_t>(std::ceil(rounded));
  return result;
}

std::vector<UnitClusters> clusters_by_unit(const SearchIndex& index) {
  std::vector<UnitClusters> units;
  for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster) {
    const int exponent = index.exponent[cluster];
    if (units.empty() || units.back().exponent != exponent)
      units.push_back({exponent, std::ldexp(1.0, exponent), cluster, cluster});
    ++units.back().last;
  }
  return units;
}

std::size_t largest_cluster(const SearchIndex& index) {
  std::size_t most = 0;
  for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster)
    most = std::max(most, index.rows(cluster));
  return most;
}

void least_distances(const UnitReadings& readings, std::span<const std::int16_t> centres,
                     std::span<std::int32_t> distances) {
#ifdef VOUSSOIR_HAS_AVX2
  if (distances.size() >= kAbreast && use_avx2())
    return readings.reading.size() == kCommonPlaces
               ? avx2_distances<kCommonPlaces>(readings, centres, distances)
               : avx2_distances<0>(readings, centres, distances);
#endif
  plain_distances(readings, centres, distances);
}

std::span<const RowBound> RowBounds::within(std::size_t cluster, const UnitReadings& readings,
                                            std::int32_t distance, std::int32_t limit) {
  const std::size_t places = index_.places, first = index_.slot(cluster), rows = index_.rows(cluster);
  const int coarseness = index_.coarseness[cluster];
  const std::int32_t room = distance - limit,
                     reach = room <= 0 ? 0 : (room + (1 << coarseness) - 1) >> coarseness;
  const auto centre = index_.centre.subspan(cluster * places, places);
  std::size_t count = 0, kept = 0;
#ifdef VOUSSOIR_HAS_AVX2
  if (places <= kMostPlaces && first + rows + kAbreast <= index_.bounds.size() && use_avx2()) {
    if (places == kCommonPlaces) {
      avx2_sides<kCommonPlaces>(centre, readings, sides_);
      count = avx2_within<kCommonPlaces>(index_, first, rows, sides_, reach, room, slots_.data());
    } else {
      avx2_sides<0>(centre, readings, sides_);
      count = avx2_within<0>(index_, first, rows, sides_, reach, room, slots_.data());
    }
  } else
#endif
  {
    plain_sides(centre, readings, sides_);
    count = plain_within(index_, first, rows, sides_, reach, room, slots_.data());
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t slot = slots_[i];
    const std::int32_t step = index_.bounds[slot].step();
    const SketchSums sums = sketch_sums(readings, centre.data(), index_.sketch.data() + slot * places, step);
    const std::int32_t loss = index_.bounds[slot].start + step * sums.sketch + readings.rounded;
    found_[kept] = {slots_[i], sums.apart - loss, readings.is_cut_off ? kUnbounded : sums.apart + loss};
    kept += sums.apart - loss <= limit ? 1 : 0;
  }
  return std::span(found_).first(kept);
}

}  // namespace voussoir
