#include "lookup/search/misfit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/not_a_number.h"
#include "core/simd/lanes.h"

namespace voussoir {
namespace {

/// NaN stays out of the sum where there is no reading, and stays in it where there is no prediction.
VOUSSOIR_INLINE DoubleLanes differences(const DoubleLanes& reading, const DoubleLanes& prediction) {
  return reading == reading ? magnitude(reading - prediction) : DoubleLanes{};
}

VOUSSOIR_INLINE double sum_row(const double* readings, const double* prediction, std::size_t points) {
  DoubleLanes even{}, odd{};
  std::size_t i = 0;
  for (; i + 2 * kLanes <= points; i += 2 * kLanes) {
    even += differences(load<DoubleLanes>(readings + i), load<DoubleLanes>(prediction + i));
    odd += differences(load<DoubleLanes>(readings + i + kLanes), load<DoubleLanes>(prediction + i + kLanes));
  }
  for (; i < points; i += kLanes) {
    const std::size_t left = std::min(points - i, kLanes);
    even += differences(load_some<DoubleLanes>(readings + i, left, kNan),
                        load_some<DoubleLanes>(prediction + i, left, kNan));
  }
  const double sum = sum_of(even + odd);
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void sum_rows(const double* readings, const double* table, const std::size_t* rows, std::size_t count,
              std::size_t points, double* sums) {
  for (std::size_t i = 0; i < count; ++i) sums[i] = sum_row(readings, table + rows[i] * points, points);
}

}  // namespace

double sum_of_differences(std::span<const double> readings, std::span<const double> prediction) {
  constexpr std::size_t kFirst = 0;
  double sum = 0.0;
  sum_rows(readings.data(), prediction.data(), &kFirst, 1, readings.size(), &sum);
  return sum;
}

double misfit_of(double sum) {
  return std::log(sum + kMisfitGuard);
}

double misfit(std::span<const double> readings, std::span<const double> prediction) {
  return misfit_of(sum_of_differences(readings, prediction));
}

std::vector<double> sums_of_differences(std::span<const double> readings, const SceneTable& table,
                                        std::span<const std::size_t> rows) {
  std::vector<double> sums(rows.size());
  sum_rows(readings.data(), table.vertical.data(), rows.data(), rows.size(), table.points, sums.data());
  return sums;
}

}  // namespace voussoir
