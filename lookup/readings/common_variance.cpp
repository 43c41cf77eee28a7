#include "lookup/readings/common_variance.h"

#include <array>

#include "core/not_a_number.h"
#include "core/simd/lanes.h"

namespace voussoir {
namespace {

VOUSSOIR_INLINE double mean_square_signal(const double* intact, const double* row, std::size_t points) {
  DoubleLanes sum{}, count{};
  for_lanes(points, [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    const DoubleLanes signal =
        load_some<DoubleLanes>(row + i, some, kNan) - load_some<DoubleLanes>(intact + i, some, kNan);
    const DoubleMask known = signal == signal;
    sum += known ? signal * signal : DoubleLanes{};
    count += known ? DoubleLanes{} + 1.0 : DoubleLanes{};
  });
  return sum_of(sum) / larger(sum_of(count), 1.0);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect(const double* intact, const double* table, std::size_t points, const std::size_t* rows,
             std::size_t count, double factor, double* results) {
  for (std::size_t i = 0; i < count; ++i)
    results[i] = factor * mean_square_signal(intact, table + rows[i] * points, points);
}

}  // namespace

std::vector<double> common_variances(std::span<const double> intact, double common, const SceneTable& table,
                                     std::span<const std::size_t> rows) {
  std::vector<double> results(rows.size(), 0.0);
  if (common > 0.0)
    collect(intact.data(), table.vertical.data(), table.points, rows.data(), rows.size(), common * common,
            results.data());
  return results;
}

double common_variance(std::span<const double> intact, double common, std::span<const double> row) {
  constexpr std::array<std::size_t, 1> kFirst = {0};
  return common_variances(intact, common, table_of_one_row(row), kFirst).front();
}

}  // namespace voussoir
