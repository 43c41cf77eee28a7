#include "lookup/evidence/level_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lookup/evidence/bounded_errors.h"
#include "lookup/evidence/nuisance_likelihood.h"
#include "lookup/evidence/row_statistics.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

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

}  // namespace

std::vector<std::vector<double>> log_likelihoods_at(const Observation& observation, Shapes shapes,
                                                    double level, const SceneTable& table,
                                                    std::span<const std::size_t> rows) {
  if (shapes.front() == NoiseShape::uniform && observation.softens_bounds()) {
    std::vector<double> logs =
        log_bounded_likelihoods(observation, scales_at(observation, level), table, rows);
    for (double& log : logs)
      if (std::isnan(log)) log = kImpossible;
    return {std::move(logs)};
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
    std::vector<double> logs =
        highest_bounded_likelihoods(observation, scales_at(observation, level), table, rows);
    for (double& log : logs) log = std::isnan(log) ? kImpossible : log;
    return logs;
  }
  const auto logs = log_likelihoods_at(observation, shapes, level, table, rows);
  std::vector<double> highest = logs.front();
  for (const std::vector<double>& of_shape : logs)
    for (std::size_t i = 0; i < rows.size(); ++i) highest[i] = std::max(highest[i], of_shape[i]);
  return highest;
}

std::vector<std::vector<double>> log_likelihoods_at_peak(const Observation& observation, Shapes shapes,
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

}  // namespace voussoir
