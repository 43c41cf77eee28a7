#include "lookup/lane_math.h"

namespace voussoir {
namespace {

VOUSSOIR_VECTORISED
void make_all_logarithms(double* values, std::size_t count) {
  Lanes lanes;
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    load(values + i, lanes);
    make_logarithm(lanes);
    store(lanes, values + i, kLanes);
  }
  load_some(values + i, count - i, lanes);
  make_logarithm(lanes);
  store(lanes, values + i, count - i);
}

VOUSSOIR_VECTORISED
void make_all_exponentials(double* values, std::size_t count) {
  Lanes lanes;
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    load(values + i, lanes);
    make_exponential(lanes);
    store(lanes, values + i, kLanes);
  }
  load_some(values + i, count - i, lanes);
  make_exponential(lanes);
  store(lanes, values + i, count - i);
}

}  // namespace

void make_logarithms(std::span<double> values) {
  make_all_logarithms(values.data(), values.size());
}

void make_exponentials(std::span<double> values) {
  make_all_exponentials(values.data(), values.size());
}

}  // namespace voussoir
