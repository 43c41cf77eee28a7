#include "core/simd/lane_math.h"

namespace voussoir {
namespace {

/// Applies a function of lanes to all values.
template <typename Function>
VOUSSOIR_INLINE void make_each(double* values, std::size_t count, Function function) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    const std::size_t some = count - i < kLanes ? count - i : kLanes;
    DoubleLanes lanes = load_some<DoubleLanes>(values + i, some, 0.0);
    function(lanes);
    store_some(lanes, some, values + i);
  }
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void make_all_logarithms(double* values, std::size_t count) {
  make_each(
      values, count, [](DoubleLanes & lanes) __attribute__((always_inline)) { make_logarithm(lanes); });
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void make_all_exponentials(double* values, std::size_t count) {
  make_each(
      values, count, [](DoubleLanes & lanes) __attribute__((always_inline)) { make_exponential(lanes); });
}

}  // namespace

void make_logarithms(std::span<double> values) {
  make_all_logarithms(values.data(), values.size());
}

void make_exponentials(std::span<double> values) {
  make_all_exponentials(values.data(), values.size());
}

}  // namespace voussoir
