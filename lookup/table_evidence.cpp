#include "lookup/table_evidence.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "lookup/evidence.h"
#include "lookup/lane_math.h"
#include "lookup/level_curve.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kCutOff = 1e-13;    // share of an integral over levels that may lie outside the range of levels
constexpr double kHopeless = 50.0;   // log of the factor beyond which a scene's probability is taken for zero

/// The evidence of every row for one shape; in the `open` rows it is an upper bound.
struct ShapeEvidence {
  NoiseShape shape;
  std::vector<double> logs;
  std::vector<std::size_t> open;
};

/// Over all levels the integral is that of a power; it is open where the largest level cuts it short.
ShapeEvidence uniform_evidence(const TableStatistics& statistics, std::span<const std::size_t> rows,
                               std::size_t count) {
  const auto n = static_cast<double>(count);
  const double cut = kLargestLevel * std::pow(kCutOff, 1.0 / n);
  const double constant = -n * std::numbers::ln2 - std::log(n * log_range());
  ShapeEvidence result{NoiseShape::uniform, statistics.largest, {}};
  for (double& largest : result.logs) largest = std::max(largest * (1.0 - kBoundTolerance), kSmallestLevel);
  make_logarithms(result.logs);
  for (std::size_t row = 0; row < statistics.rows(); ++row)
    result.logs[row] = constant - n * result.logs[row] - statistics.sum_log_scale[row];
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(result.open),
               [&](std::size_t row) { return statistics.largest[row] >= cut; });
  return result;
}

/// Over all levels the integral of exp(-count u - a exp(-power u)) is Gamma(order) a^(-order) / power with
/// order = count / power; it is open where either end of the range of levels cuts it short.
ShapeEvidence smooth_evidence(NoiseShape shape, const TableStatistics& statistics, std::span<const std::size_t> rows,
                              std::size_t count) {
  const LevelCurve unit = level_curve(shape, {1.0, 1.0, 1.0, 0.0}, count);  // a for sums of one
  const double order = unit.count / unit.power;
  const double least = boost::math::gamma_q_inv(order, kCutOff) * std::pow(kSmallestLevel, unit.power);
  const double most = boost::math::gamma_p_inv(order, kCutOff) * std::pow(kLargestLevel, unit.power);
  const double constant = unit.constant + std::lgamma(order) - std::log(unit.power * log_range()) - order * std::log(unit.a);
  const std::vector<double>& sums = shape == NoiseShape::laplace ? statistics.sum_absolute : statistics.sum_square;
  ShapeEvidence result{shape, sums, {}};
  make_logarithms(result.logs);
  for (std::size_t row = 0; row < statistics.rows(); ++row)
    result.logs[row] = constant - order * result.logs[row] - statistics.sum_log_scale[row];
  for (const std::size_t row : rows) {
    if (unit.a * sums[row] >= least && unit.a * sums[row] <= most) continue;
    result.open.push_back(row);
    const RowStatistics one = statistics.row(row);
    result.logs[row] = log_likelihood(shape, one, count, likeliest_level(shape, one, count));
  }
  return result;
}

ShapeEvidence shape_evidence(NoiseShape shape, const TableStatistics& statistics, std::span<const std::size_t> rows,
                             std::size_t count) {
  ShapeEvidence result = shape == NoiseShape::uniform ? uniform_evidence(statistics, rows, count)
                                                      : smooth_evidence(shape, statistics, rows, count);
  for (const std::size_t row : rows)
    if (std::isnan(statistics.sum_absolute[row])) result.logs[row] = kImpossible;
  return result;
}

/// The largest evidence that is no mere bound.
double largest_known(const ShapeEvidence& evidence, std::span<const std::size_t> rows) {
  std::vector<double> known = evidence.logs;
  for (const std::size_t row : evidence.open) known[row] = kImpossible;
  double result = kImpossible;
  for (const std::size_t row : rows) result = std::max(result, known[row]);
  return result;
}

/// Works out the open rows from the largest bound down to what is hopeless against `best`, which rises on the way.
void close(ShapeEvidence& evidence, const TableStatistics& statistics, std::size_t count, double& best) {
  std::sort(evidence.open.begin(), evidence.open.end(), [&](std::size_t a, std::size_t b) {
    return evidence.logs[a] != evidence.logs[b] ? evidence.logs[a] > evidence.logs[b] : a < b;
  });
  for (const std::size_t row : evidence.open) {
    double& value = evidence.logs[row];
    value = value < best - kHopeless ? kImpossible : log_evidence(evidence.shape, statistics.row(row), count);
    best = std::max(best, value);
  }
  evidence.open.clear();
}

}  // namespace

std::vector<double> log_likelihoods(NoiseShape shape, const TableStatistics& statistics, std::size_t count) {
  const bool bounded = shape == NoiseShape::uniform;
  const LevelCurve unit = level_curve(shape, {1.0, 1.0, 1.0, 0.0}, count);
  const std::vector<double>& sums = shape == NoiseShape::laplace ? statistics.sum_absolute : statistics.sum_square;
  const double constant = bounded ? -unit.count * std::numbers::ln2 : unit.constant;
  const double factor = bounded ? 0.0 : unit.a;
  const double limit = bounded ? 1.0 + kBoundTolerance : std::numeric_limits<double>::infinity();
  std::vector<double> result(statistics.rows());
  for (std::size_t row = 0; row < result.size(); ++row) {
    const bool possible = statistics.largest[row] <= limit && !std::isnan(statistics.sum_absolute[row]);
    result[row] = possible ? constant - factor * sums[row] - statistics.sum_log_scale[row] : kImpossible;
  }
  return result;
}

std::vector<double> log_mean_evidences(std::span<const NoiseShape> shapes, const TableStatistics& statistics,
                                       std::span<const std::size_t> rows, std::size_t count) {
  std::vector<ShapeEvidence> parts;
  double best = kImpossible;
  for (const NoiseShape shape : shapes) {
    parts.push_back(shape_evidence(shape, statistics, rows, count));
    best = std::max(best, largest_known(parts.back(), rows));
  }
  std::vector<std::vector<double>> logs;
  for (ShapeEvidence& part : parts) {
    close(part, statistics, count, best);
    logs.push_back(std::move(part.logs));
  }
  return log_mean(logs);
}

std::vector<double> log_mean(const std::vector<std::vector<double>>& logs) {
  if (logs.size() == 1) return logs.front();
  const std::size_t rows = logs.front().size();
  std::vector<double> largest = logs.front();
  for (const std::vector<double>& values : logs)
    for (std::size_t row = 0; row < rows; ++row) largest[row] = std::max(largest[row], values[row]);
  std::vector<double> sum(rows, 0.0);
  std::vector<double> part(rows);
  for (const std::vector<double>& values : logs) {
    for (std::size_t row = 0; row < rows; ++row) part[row] = values[row] - largest[row];
    make_exponentials(part);
    for (std::size_t row = 0; row < rows; ++row) sum[row] += part[row];
  }
  make_logarithms(sum);
  const double log_count = std::log(static_cast<double>(logs.size()));
  for (std::size_t row = 0; row < rows; ++row)
    largest[row] = largest[row] == kImpossible ? kImpossible : largest[row] + sum[row] - log_count;
  return largest;
}

}  // namespace voussoir
