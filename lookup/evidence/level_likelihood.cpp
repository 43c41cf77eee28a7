#include "lookup/evidence/level_likelihood.h"

#include <algorithm>
#include <cmath>

#include "lookup/evidence/bounded_errors.h"
#include "lookup/evidence/nuisance_likelihood.h"
#include "lookup/evidence/row_blocks.h"
#include "lookup/evidence/row_statistics.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

TableStatistics statistics_at(const Observation& observation, Shapes shapes, double level,
                              const SceneTable& table, std::span<const std::size_t> rows) {
  const ErrorScales scales = scales_at(observation, level);
  if (observation.has_levelling()) return nuisance_statistics(observation, scales, table, rows);
  return table_statistics(observation, scales, table, rows,
                          shapes.front() == NoiseShape::uniform ? ErrorSum::beyond : ErrorSum::variance);
}

/// For each shape a value for each row; -infinity for those that are impossible.
template <typename Value>
std::vector<std::vector<double>> of_possible_rows(Shapes shapes, const TableStatistics& statistics,
                                                  Value value) {
  std::vector<std::vector<double>> results;
  for (const NoiseShape shape : shapes) {
    results.emplace_back(statistics.rows(), kImpossible);
    for (std::size_t row = 0; row < statistics.rows(); ++row)
      if (!std::isnan(statistics.sum_absolute[row])) results.back()[row] = value(shape, statistics.row(row));
  }
  return results;
}

/// Of bounded errors, whose sums are NaN for impossible rows.
std::vector<double> with_impossible_rows(std::vector<double> logs) {
  for (double& log : logs)
    if (std::isnan(log)) log = kImpossible;
  return logs;
}

/// Of uniform noise at the level whose bounds take in all readings; where none does, at the largest.
std::vector<double> within_bounds(const Observation& observation, double level,
                                  const TableStatistics& statistics, const SceneTable& table,
                                  std::span<const std::size_t> rows) {
  const double most = kLargestLevel / level;
  std::vector<double> results(rows.size(), kImpossible);
  std::vector<std::size_t> places, beyond;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RowStatistics row = statistics.row(i);
    if (std::isnan(row.sum_absolute)) continue;
    results[i] = log_within_bound(row, observation.count,
                                  likeliest_level(NoiseShape::uniform, row, observation.count, level));
    if (row.largest < most || !observation.softens_bounds()) continue;
    places.push_back(i);
    beyond.push_back(rows[i]);
  }
  const std::vector<double> logs =
      log_bounded_likelihoods(observation, scales_at(observation, kLargestLevel), table, beyond);
  for (std::size_t k = 0; k < places.size(); ++k) results[places[k]] = logs[k];
  return results;
}

/// For each shape: what estimated_peaks says of it.
std::vector<std::vector<double>> likelihoods_at_peak(const Observation& observation, Shapes shapes,
                                                     double level, const SceneTable& table,
                                                     std::span<const std::size_t> rows) {
  const TableStatistics statistics = statistics_at(observation, shapes, level, table, rows);
  if (shapes.front() == NoiseShape::uniform)
    return {within_bounds(observation, level, statistics, table, rows)};
  return of_possible_rows(shapes, statistics, [&](NoiseShape shape, const RowStatistics& row) {
    if (shape == NoiseShape::student)
      return student_log_likelihood(row, observation.count, observation.noise.degrees_of_freedom);
    return log_likelihood(shape, row, observation.count,
                          likeliest_level(shape, row, observation.count, level));
  });
}

/// For each row.
std::vector<double> largest_over_shapes(const std::vector<std::vector<double>>& logs) {
  std::vector<double> largest(logs.front().size(), kImpossible);
  for (const std::vector<double>& of_shape : logs)
    for (std::size_t i = 0; i < largest.size(); ++i) largest[i] = std::max(largest[i], of_shape[i]);
  return largest;
}

}  // namespace

std::vector<std::vector<double>> log_likelihoods_at(const Observation& observation, Shapes shapes,
                                                    double level, const SceneTable& table,
                                                    std::span<const std::size_t> rows) {
  if (shapes.front() == NoiseShape::uniform && observation.softens_bounds()) {
    const ErrorScales scales = scales_at(observation, level);
    return {with_impossible_rows(log_bounded_likelihoods(observation, scales, table, rows))};
  }
  const TableStatistics statistics = statistics_at(observation, shapes, level, table, rows);
  return of_possible_rows(shapes, statistics, [&](NoiseShape shape, const RowStatistics& row) {
    if (shape == NoiseShape::student)
      return student_log_likelihood(row, observation.count, observation.noise.degrees_of_freedom);
    return log_likelihood(shape, row, observation.count);
  });
}

std::vector<double> highest_likelihoods_at(const Observation& observation, Shapes shapes, double level,
                                           const SceneTable& table, std::span<const std::size_t> rows) {
  if (shapes.front() == NoiseShape::uniform && observation.softens_bounds()) {
    const ErrorScales scales = scales_at(observation, level);
    return with_impossible_rows(highest_bounded_likelihoods(observation, scales, table, rows));
  }
  return largest_over_shapes(log_likelihoods_at(observation, shapes, level, table, rows));
}

std::vector<double> estimated_peaks(const Observation& observation, Shapes shapes, double level,
                                    const SceneTable& table, std::span<const std::size_t> rows) {
  std::vector<double> result(rows.size());
  for_row_blocks_on_threads(rows, [&](std::span<const std::size_t> block) {
    std::ranges::copy(largest_over_shapes(likelihoods_at_peak(observation, shapes, level, table, block)),
                      result.begin() + (block.data() - rows.data()));
  });
  return result;
}

}  // namespace voussoir
