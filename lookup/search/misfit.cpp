#include "lookup/search/misfit.h"

#include <cmath>
#include <limits>

#include "core/simd/lane_arithmetic.h"

namespace voussoir {
namespace {

/// NaN stays out of the sum where there is no reading, and stays in it where there is no prediction.
VOUSSOIR_INLINE void add_differences(const Lanes& reading, const Lanes& prediction, Lanes& sum) {
  Lanes difference = reading - prediction;
  make_absolute(difference);
  sum += reading == reading ? difference : Lanes{};
}

VOUSSOIR_INLINE double sum_row(const double* readings, const double* prediction, std::size_t points) {
  Lanes even{}, odd{}, reading, predicted;
  std::size_t i = 0;
  for (; i + 2 * kLanes <= points; i += 2 * kLanes) {
    load(readings + i, reading);
    load(prediction + i, predicted);
    add_differences(reading, predicted, even);
    load(readings + i + kLanes, reading);
    load(prediction + i + kLanes, predicted);
    add_differences(reading, predicted, odd);
  }
  for (; i < points; i += kLanes) {
    const std::size_t left = points - i < kLanes ? points - i : kLanes;
    load_some(readings + i, left, reading);
    load_some(prediction + i, left, predicted);
    add_differences(reading, predicted, even);
  }
  even += odd;
  const double sum = (even[0] + even[1]) + (even[2] + even[3]);
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void sum_rows(const double* readings, const double* table, std::size_t rows, std::size_t points,
              double* sums) {
  for (std::size_t row = 0; row < rows; ++row) sums[row] = sum_row(readings, table + row * points, points);
}

}  // namespace

double sum_of_differences(std::span<const double> readings, std::span<const double> prediction) {
  double sum = 0.0;
  sum_rows(readings.data(), prediction.data(), 1, readings.size(), &sum);
  return sum;
}

double misfit_of(double sum) {
  return std::log(sum + kMisfitGuard);
}

double misfit(std::span<const double> readings, std::span<const double> prediction) {
  return misfit_of(sum_of_differences(readings, prediction));
}

std::vector<double> sums_of_differences(std::span<const double> readings, const SceneTable& table) {
  std::vector<double> sums(table.rows);
  sum_rows(readings.data(), table.vertical.data(), table.rows, table.points, sums.data());
  return sums;
}

}  // namespace voussoir
