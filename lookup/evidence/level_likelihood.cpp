#include "lookup/evidence/level_likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lookup/evidence/bounded_errors.h"
#include "lookup/evidence/row_blocks.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/common_variance.h"

namespace voussoir {
namespace {

TableStatistics statistics_at(const Observation& observation, Shapes shapes, double level,
                              const SceneTable& table, std::span<const std::size_t> rows) {
  if (observation.has_levelling()) return nuisance_statistics(observation, level, table, rows);
  return table_statistics(observation, scales_at(observation, level), table, rows,
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

/// Of a possible row at the statistics' own level.
double log_likelihood_of(const Observation& observation, NoiseShape shape, const RowStatistics& row) {
  if (shape == NoiseShape::student)
    return student_log_likelihood(row, observation.count, observation.noise.degrees_of_freedom);
  return log_likelihood(shape, row, observation.count);
}

/// Errors of one shape whose bounds are softened by others.
bool has_soft_bounds(const Observation& observation, Shapes shapes) {
  return shapes.front() == NoiseShape::uniform && observation.softens_bounds();
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
  if (has_soft_bounds(observation, shapes)) {
    const ErrorScales scales = scales_at(observation, level);
    return {with_impossible_rows(log_bounded_likelihoods(observation, scales, table, rows))};
  }
  const TableStatistics statistics = statistics_at(observation, shapes, level, table, rows);
  return of_possible_rows(shapes, statistics, [&](NoiseShape shape, const RowStatistics& row) {
    return log_likelihood_of(observation, shape, row);
  });
}

RowLikelihood::RowLikelihood(const Observation& observation, Shapes shapes)
    : observation_(observation),
      shapes_(shapes),
      is_soft_(has_soft_bounds(observation, shapes)),
      row_(observation, is_soft_ ? 0.5 : 1.0) {
  if (observation.has_levelling()) levelled_.emplace(observation);
}

void RowLikelihood::take(std::span<const double> prediction) {
  if (levelled_)
    levelled_->take(prediction, common_variance(observation_.intact, observation_.error_common, prediction));
  else
    row_.take(prediction);
}

std::array<double, kMostShapes> RowLikelihood::at(double level) {
  std::array<double, kMostShapes> logs{kImpossible, kImpossible};
  if (is_soft_) {
    logs.front() = log_bounded_likelihood({row_, level});
  } else {
    const RowStatistics statistics = levelled_ ? levelled_->at(level) : row_statistics({row_, level});
    for (std::size_t i = 0; i < shapes_.size(); ++i)
      logs.at(i) = log_likelihood_of(observation_, shapes_[i], statistics);
  }
  for (double& log : logs)
    if (std::isnan(log)) log = kImpossible;
  return logs;
}

std::vector<double> highest_likelihoods_at(const Observation& observation, Shapes shapes, double level,
                                           const SceneTable& table, std::span<const std::size_t> rows) {
  if (has_soft_bounds(observation, shapes)) {
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
