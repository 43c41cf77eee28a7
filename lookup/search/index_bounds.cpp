#include "lookup/search/index_bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/simd/short_lanes.h"

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

/// Adds sum |reading - row| over kShortLanes places.
VOUSSOIR_AVX2 inline void add_apart(ShortLanes reading, ShortLanes is_read, ShortLanes row, IntLanes& sum) {
  sum += paired_products(magnitude(reading - row), is_read);
}

/// As plain_distances, for at least kAbreast. kPlaces, here and below: of a row if known when compiled, else
/// 0.
template <std::size_t kPlaces>
VOUSSOIR_AVX2 void avx2_distances(const UnitReadings& readings, std::span<const std::int16_t> centres,
                                  std::span<std::int32_t> distances) {
  const std::size_t places = kPlaces != 0 ? kPlaces : readings.reading.size();
  for (std::size_t next = 0; next < distances.size(); next += kAbreast) {
    const std::size_t cluster = std::min(next, distances.size() - kAbreast);  // the last ones perhaps twice
    const std::int16_t* const first = centres.data() + cluster * places;
    IntLanes sums[kAbreast] = {};
    for (std::size_t i = 0; i < places; i += kShortLanes) {
      const auto reading = load<ShortLanes>(readings.reading.data() + i);
      const auto is_read = load<ShortLanes>(readings.is_read.data() + i);
      for (std::size_t row = 0; row < kAbreast; ++row)
        add_apart(reading, is_read, load<ShortLanes>(first + row * places + i), sums[row]);
    }
    store_some(sums_of(sums) - readings.rounded, kAbreast, distances.data() + cluster);
  }
}

template <std::size_t kPlaces>
VOUSSOIR_AVX2 void avx2_sides(std::span<const std::int16_t> centre, const UnitReadings& readings,
                              std::span<std::uint8_t> sides) {
  const std::size_t places = kPlaces != 0 ? kPlaces : sides.size();
  for (std::size_t i = 0; i < places; i += kShortLanes) {
    const auto reading = load<ShortLanes>(readings.reading.data() + i);
    const auto is_read = load<ShortLanes>(readings.is_read.data() + i);
    const ShortLanes above = (reading > load<ShortLanes>(centre.data() + i)) | 1;  // -1 above, 1 elsewhere
    store_as_bytes(1 - (above & -is_read), sides.data() + i);
  }
}

/// For kAbreast rows the sums of side * sketch. Each product adds 2 * 2 * 127 to a number of 16 bits at most,
/// so that rows of up to kMostPlaces are safe.
VOUSSOIR_AVX2 VOUSSOIR_INLINE FourInts avx2_sums(const std::int8_t* sketch, const std::uint8_t* sides,
                                                 std::size_t places) {
  const std::size_t paired = places / kByteLanes * kByteLanes;
  const std::int8_t *second = sketch + places, *third = second + places, *fourth = third + places;
  ShortLanes a{}, b{}, c{}, d{};
#pragma GCC unroll 4
  for (std::size_t i = 0; i < paired; i += kByteLanes) {
    const auto side = load<UnsignedByteLanes>(sides + i);
    a += paired_products(side, load<ByteLanes>(sketch + i));
    b += paired_products(side, load<ByteLanes>(second + i));
    c += paired_products(side, load<ByteLanes>(third + i));
    d += paired_products(side, load<ByteLanes>(fourth + i));
  }
  if (paired < places) {
    const auto side = load<UnsignedHalfByteLanes>(sides + paired);
    a += paired_products(side, load<HalfByteLanes>(sketch + paired));
    b += paired_products(side, load<HalfByteLanes>(second + paired));
    c += paired_products(side, load<HalfByteLanes>(third + paired));
    d += paired_products(side, load<HalfByteLanes>(fourth + paired));
  }
  const ShortLanes one = ShortLanes{} + 1;
  return sums_of(
      {paired_products(a, one), paired_products(b, one), paired_products(c, one), paired_products(d, one)});
}

/// SlotBounds of kAbreast rows, member by member.
struct FourBounds {
  FourUnsigned distance_and_step;
  FourInts start;
};
VOUSSOIR_AVX2 inline FourBounds four_bounds(const SlotBounds* from) {
  FourUnsigned first, second;
  std::memcpy(&first, from, sizeof first);
  std::memcpy(&second, from + 2, sizeof second);
  return {__builtin_shufflevector(first, second, 0, 2, 4, 6),
          reinterpret_cast<FourInts>(__builtin_shufflevector(first, second, 1, 3, 5, 7))};
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
  for (std::size_t row = 0; row < rows; row += kAbreast, sketch += kAbreast * places, from += kAbreast) {
    if (from->distance() < reach) break;
    const FourInts sums = avx2_sums(sketch, sides.data(), places);
    const FourBounds bounds = four_bounds(from);
    const FourInts nearer = sums * reinterpret_cast<FourInts>(bounds.distance_and_step >> 16) + bounds.start;
    for (unsigned within = bits_of(nearer >= room); within != 0; within &= within - 1) {
      const std::size_t member = row + static_cast<std::size_t>(std::countr_zero(within));
      found[count] = static_cast<std::uint32_t>(first + member);
      count += member < rows ? 1 : 0;
    }
  }
  return count;
}

VOUSSOIR_AVX2 SketchSums avx2_sketch_sums(const UnitReadings& readings, const std::int16_t* centre,
                                          const std::int8_t* sketch, std::int32_t step) {
  const ShortLanes one = ShortLanes{} + 1;
  IntLanes sums[kAbreast] = {};
  for (std::size_t i = 0; i < readings.reading.size(); i += kShortLanes) {
    const auto row = load<ShortLanes>(sketch + i);
    add_apart(load<ShortLanes>(readings.reading.data() + i), load<ShortLanes>(readings.is_read.data() + i),
              load<ShortLanes>(centre + i) + row * static_cast<std::int16_t>(step), sums[0]);
    sums[1] += paired_products(row, one);
  }
  const FourInts both = sums_of(sums);
  return {both[0], both[1]};
}
#endif

SketchSums sketch_sums(const UnitReadings& readings, const std::int16_t* centre, const std::int8_t* sketch,
                       std::int32_t step) {
#ifdef VOUSSOIR_HAS_AVX2
  if (has_avx2()) return avx2_sketch_sums(readings, centre, sketch, step);
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
  if (distances.size() >= kAbreast && has_avx2())
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
  if (places <= kMostPlaces && first + rows + kAbreast <= index_.bounds.size() && has_avx2()) {
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
