#include "core/simd/lane_math.h"

namespace voussoir {
namespace {

/// Applies a function of lanes to all values.
template <typename Function>
VOUSSOIR_INLINE void make_each(double* values, std::size_t count, Function function) {
  Lanes lanes;
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    load(values + i, lanes);
    function(lanes);
    store(lanes, values + i, kLanes);
  }
  load_some(values + i, count - i, lanes);
  function(lanes);
  store(lanes, values + i, count - i);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void make_all_logarithms(double* values, std::size_t count) {
  make_each(
      values, count, [](Lanes & lanes) __attribute__((always_inline)) { make_logarithm(lanes); });
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void make_all_exponentials(double* values, std::size_t count) {
  make_each(
      values, count, [](Lanes & lanes) __attribute__((always_inline)) { make_exponential(lanes); });
}

}  // namespace

void make_logarithms(std::span<double> values) {
  make_all_logarithms(values.data(), values.size());
}

void make_exponentials(std::span<double> values) {
  make_all_exponentials(values.data(), values.size());
}

}  // namespace voussoir
