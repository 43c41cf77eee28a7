#include "lookup/sketch_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#ifdef __x86_64__
#define VOUSSOIR_HAS_AVX2
#include <immintrin.h>
#endif

#include "lookup/exhaustive_search.h"

namespace voussoir {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kSegment = 8;    // places that share a step: what one instruction sums up
constexpr std::size_t kRegister = 32;  // bytes: sketches are filled up to a whole number of them
constexpr std::size_t kBlock = 32;     // rows whose bounds are looked at together first
constexpr double kLargestByte = 255.0;
constexpr double kRange = 0.3;           // of bytes, as a share of the segment's largest intact displacement:
                                         // readings with up to 15 % of noise stay within it
constexpr double kLeastRange = 1e-4;     // [m] for segments that hardly move
constexpr float kSafety = 1.0F - 1e-5F;  // bounds are computed in single precision
constexpr double kWorthwhile = 0.25;     // share of rows left beyond which scoring all of them is faster

double byte_of(double value, double base, double step) {
  return std::clamp(std::round((value - base) / step), 0.0, kLargestByte);
}

/// What rounding takes from a value drawn to the range of bytes [m].
double rounding_error(double value, double base, double step) {
  const double drawn = std::clamp((value - base) / step, 0.0, kLargestByte);
  return step * std::abs(drawn - std::round(drawn));
}

/// Points in descending order of their intact displacement, so that neighbours can share a step.
std::vector<std::size_t> places(std::span<const double> intact) {
  std::vector<std::size_t> order(intact.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return std::abs(intact[a]) > std::abs(intact[b]); });
  order.resize((order.size() + kRegister - 1) / kRegister * kRegister, kNone);
  return order;
}

/// What the distance of many sketches to one needs; all arrays have a whole number of registers.
struct Comparison {
  const std::uint8_t* sketches;
  const std::uint8_t* query;
  const std::uint8_t* mask;
  const std::uint64_t* weight;  // of each segment
  std::size_t places;           // of a sketch
};

/// The sum over segments of weight * (sum of |byte - byte| in the segment), for sketches `first` up to
/// `last`.
void plain_distances(const Comparison& comparison, std::size_t first, std::size_t last, float* distances) {
  for (std::size_t i = first; i < last; ++i) {
    const std::uint8_t* const sketch = comparison.sketches + i * comparison.places;
    std::uint64_t sum = 0;
    for (std::size_t place = 0; place < comparison.places; ++place)
      sum += comparison.weight[place / kSegment] *
             static_cast<std::uint64_t>(
                 std::abs((sketch[place] & comparison.mask[place]) - comparison.query[place]));
    distances[i] = static_cast<float>(sum);
  }
}

#ifdef VOUSSOIR_HAS_AVX2
__attribute__((target("avx2"))) void avx2_distances(const Comparison& comparison, std::size_t first,
                                                    std::size_t last, float* distances) {
  const auto at = [](const void* bytes, std::size_t offset) {
    return reinterpret_cast<const __m256i*>(static_cast<const std::uint8_t*>(bytes) + offset);
  };
  for (std::size_t i = first; i < last; ++i) {
    const std::uint8_t* const sketch = comparison.sketches + i * comparison.places;
    __m256i sum = _mm256_setzero_si256();
    for (std::size_t place = 0; place < comparison.places; place += kRegister) {
      const __m256i bytes = _mm256_and_si256(_mm256_loadu_si256(at(sketch, place)),
                                             _mm256_loadu_si256(at(comparison.mask, place)));
      const __m256i parts = _mm256_sad_epu8(bytes, _mm256_loadu_si256(at(comparison.query, place)));
      sum = _mm256_add_epi64(sum, _mm256_mul_epu32(parts, _mm256_loadu_si256(at(comparison.weight, place))));
    }
    const __m128i half = _mm_add_epi64(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
    distances[i] = static_cast<float>(_mm_cvtsi128_si64(half) + _mm_extract_epi64(half, 1));
  }
}
#endif

void sketch_distances(const Comparison& comparison, std::size_t first, std::size_t last, float* distances) {
#ifdef VOUSSOIR_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) return avx2_distances(comparison, first, last, distances);
#endif
  plain_distances(comparison, first, last, distances);
}

/// Lower bounds of the sums of all rows.
struct SketchBounds {
  std::vector<float> row;
  std::vector<float> block;  // the smallest of each block of rows

  /// Calls a function with the positions of bounds not above a limit that may fall on the way, until it gives
  /// false.
  template <typename Limit, typename Function>
  void for_each_below(Limit limit, Function function) const {
    for (std::size_t b = 0; b < block.size(); ++b) {
      if (block[b] > limit()) continue;
      for (std::size_t i = b * kBlock; i < std::min(row.size(), (b + 1) * kBlock); ++i)
        if (row[i] <= limit() && !function(i)) return;
    }
  }
};

/// Keeps the smallest sums seen.
class BestSums {
 public:
  explicit BestSums(std::size_t count) : count_(count) {}

  void add(double sum) {
    heap_.push_back(sum);
    std::push_heap(heap_.begin(), heap_.end());
    if (heap_.size() <= count_) return;
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
  }

  /// Sums above it cannot be among the best `count`.
  double limit() const {
    return heap_.size() < count_ ? std::numeric_limits<double>::infinity() : heap_.front();
  }

 private:
  std::size_t count_;
  std::vector<double> heap_;
};

/// Positions of the `count` smallest bounds.
std::vector<std::size_t> smallest(const SketchBounds& bounds, std::size_t count) {
  std::vector<std::size_t> heap;
  const auto less = [&](std::size_t a, std::size_t b) { return bounds.row[a] < bounds.row[b]; };
  const auto limit = [&] {
    return heap.size() < count ? std::numeric_limits<float>::infinity() : bounds.row[heap.front()];
  };
  bounds.for_each_below(limit, [&](std::size_t i) {
    heap.push_back(i);
    std::push_heap(heap.begin(), heap.end(), less);
    if (heap.size() <= count) return true;
    std::pop_heap(heap.begin(), heap.end(), less);
    heap.pop_back();
    return true;
  });
  return heap;
}

SketchBounds lower_bounds(const Comparison& comparison, const std::vector<float>& row_error, float unit,
                          double error, double worst_row_error) {
  SketchBounds bounds{std::vector<float>(row_error.size()), {}};
  for (std::size_t first = 0; first < row_error.size(); first += kBlock) {
    const std::size_t last = std::min(row_error.size(), first + kBlock);
    sketch_distances(comparison, first, last, bounds.row.data());
    float smallest_of_block = std::numeric_limits<float>::infinity();
    for (std::size_t i = first; i < last; ++i) {
      const float rounding =
          static_cast<float>(error) + std::min(row_error[i], static_cast<float>(worst_row_error));
      bounds.row[i] = unit * bounds.row[i] * kSafety - rounding / kSafety;
      smallest_of_block = std::min(smallest_of_block, bounds.row[i]);
    }
    bounds.block.push_back(smallest_of_block);
  }
  return bounds;
}

}  // namespace

SketchIndex::SketchIndex(const SceneTable& table, std::span<const std::size_t> rows,
                         std::span<const double> intact)
    : table_(table),
      rows_(rows.begin(), rows.end()),
      order_(places(intact)),
      base_(order_.size(), 0.0),
      weight_(order_.size() / kSegment, 1),
      bytes_(rows.size() * order_.size(), 0),
      row_error_(rows.size(), 0.0F) {
  constexpr double kFinest = 65536.0;  // units in the largest step
  const auto range = [&](std::size_t segment) {
    const std::size_t first = order_[segment * kSegment];
    return first == kNone ? kLeastRange : std::max(kLeastRange, kRange * std::abs(intact[first]));
  };
  unit_ = range(0) / kLargestByte / kFinest;
  for (std::size_t segment = 0; segment < weight_.size(); ++segment)
    weight_[segment] = static_cast<std::uint64_t>(std::ceil(range(segment) / kLargestByte / unit_));
  for (std::size_t place = 0; place < order_.size(); ++place)
    if (order_[place] != kNone) base_[place] = intact[order_[place]] - 0.5 * kLargestByte * step(place);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::span<const double> row = table.row(rows_[i]);
    double error = 0.0;
    for (std::size_t place = 0; place < order_.size(); ++place) {
      if (order_[place] == kNone || std::isnan(row[order_[place]]))
        continue;  // no displacement: any byte will do
      const double value = row[order_[place]];
      bytes_[i * order_.size() + place] =
          static_cast<std::uint8_t>(byte_of(value, base_[place], step(place)));
      error += rounding_error(value, base_[place], step(place));
    }
    row_error_[i] = std::nextafter(static_cast<float>(error), std::numeric_limits<float>::infinity());
  }
}

double SketchIndex::step(std::size_t place) const {
  return static_cast<double>(weight_[place / kSegment]) * unit_;
}

SketchIndex::Query SketchIndex::sketch(std::span<const double> readings) const {
  Query query{std::vector<std::uint8_t>(order_.size(), 0), std::vector<std::uint8_t>(order_.size(), 0)};
  for (std::size_t place = 0; place < order_.size(); ++place) {
    if (order_[place] == kNone || std::isnan(readings[order_[place]])) continue;
    const double value = readings[order_[place]];
    query.bytes[place] = static_cast<std::uint8_t>(byte_of(value, base_[place], step(place)));
    query.mask[place] = static_cast<std::uint8_t>(kLargestByte);
    query.error += rounding_error(value, base_[place], step(place));
    query.worst_row_error += 0.5 * step(place);
  }
  return query;
}

SketchIndex::Result SketchIndex::search(std::span<const double> readings, std::size_t count) const {
  if (count == 0) return {};
  const Query query = sketch(readings);
  const Comparison comparison{bytes_.data(), query.bytes.data(), query.mask.data(), weight_.data(),
                              order_.size()};
  const SketchBounds bounds =
      lower_bounds(comparison, row_error_, static_cast<float>(unit_), query.error, query.worst_row_error);
  BestSums best(count);
  std::vector<ScoredRow> scored;
  const auto score = [&](std::size_t i) {
    scored.push_back({rows_[i], sum_of_differences(readings, table_.row(rows_[i]))});
    best.add(scored.back().sum);
  };
  const std::vector<std::size_t> probes = smallest(bounds, count);
  for (const std::size_t i : probes) score(i);
  const auto most = static_cast<std::size_t>(kWorthwhile * static_cast<double>(rows_.size()));
  bounds.for_each_below([&] { return best.limit(); },
                        [&](std::size_t i) {
                          if (std::find(probes.begin(), probes.end(), i) == probes.end()) score(i);
                          return scored.size() <= most;
                        });
  if (scored.size() > most) return {exhaustive_search(readings, table_, rows_, count), rows_.size(), true};
  const std::size_t number = scored.size();
  return {best_rows(std::move(scored), count), number, false};
}

}  // namespace voussoir
