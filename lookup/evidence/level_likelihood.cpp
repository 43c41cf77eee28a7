#include "lookup/evidence/level_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lookup/evidence/bounded_errors.h"
#include "lookup/evidence/nuisance_likelihood.h"
#include "lookup/evidence/row_statistics.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// A log likelihood as a function of the level, relative to the one that the statistics were taken at:
/// constant - count log(r) - sum / r^power, where the errors grow with r alone.
struct ScaledLikelihood {
  double constant;
  double count;
  double sum;
  double power;

  double at_peak(double level) const {
    const double share = power * sum / count;
    const double fitting = power == 2.0 ? std::sqrt(share) : share;
    const double r = std::clamp(fitting, kSmallestLevel / level, kLargestLevel / level);
    return constant - count * std::log(r) - sum / (power == 2.0 ? r * r : r);
  }
};

/// Of Gaussian and Laplace shapes.
ScaledLikelihood scaled_likelihood(NoiseShape shape, const RowStatistics& statistics, double count) {
  const double constant =
      count * log_density(shape, 0.0, 0.0) - statistics.sum_log_scale - 0.5 * statistics.scale_square;
  if (shape == NoiseShape::laplace)
    return {constant, count, std::numbers::sqrt2 * statistics.sum_absolute, 1.0};
  return {constant, count, 0.5 * statistics.sum_square, 2.0};
}

double student_log_likelihood(const RowStatistics& statistics, double count, double nu) {
  return count * log_density(NoiseShape::student, 0.0, nu) - statistics.sum_log_scale -
         0.5 * (nu + 1.0) * statistics.sum_log_student - 0.5 * statistics.scale_square;
}

/// The logarithm of the density of errors within the bound.
double log_inside(const RowStatistics& statistics, double count) {
  return -count * std::numbers::ln2 - statistics.sum_log_scale - 0.5 * statistics.scale_square;
}

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
  const auto count = static_cast<double>(observation.count);
  const TableStatistics statistics = statistics_at(observation, shapes, level, table, rows);
  return of_possible_rows(shapes, statistics, [&](NoiseShape shape, const RowStatistics& row) {
    if (shape == NoiseShape::uniform)
      return row.largest <= 1.0 + kBoundTolerance ? log_inside(row, count) : kImpossible;
    if (shape == NoiseShape::student)
      return student_log_likelihood(row, count, observation.noise.degrees_of_freedom);
    const ScaledLikelihood scaled = scaled_likelihood(shape, row, count);
    return scaled.constant - scaled.sum;
  });
}

std::vector<std::vector<double>> log_likelihoods_at_peak(const Observation& observation, Shapes shapes,
                                                         double level, const SceneTable& table,
                                                         std::span<const std::size_t> rows) {
  const auto count = static_cast<double>(observation.count);
  const TableStatistics statistics = statistics_at(observation, shapes, level, table, rows);
  return of_possible_rows(shapes, statistics, [&](NoiseShape shape, const RowStatistics& row) {
    if (shape == NoiseShape::uniform)
      return log_inside(row, count) -
             count * std::log(std::clamp(row.largest, kSmallestLevel / level, kLargestLevel / level));
    if (shape == NoiseShape::student)
      return student_log_likelihood(row, count, observation.noise.degrees_of_freedom);
    return scaled_likelihood(shape, row, count).at_peak(level);
  });
}

}  // namespace voussoir
