#include "lookup/evidence/table_evidence.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

#include "core/simd/lane_math.h"
#include "lookup/evidence/level_curve.h"
#include "lookup/evidence/level_evidence.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr double kTail = 1e-13;  // share of an integral over levels that may lie outside the range of levels

/// The evidence of every row for one shape; in the `open` rows it is an upper bound.
struct ShapeEvidence {
  NoiseShape shape;
  std::vector<double> logs;
  std::vector<std::size_t> open;
};

const std::vector<double>& sums_for(NoiseShape shape, const TableStatistics& statistics) {
  return shape == NoiseShape::uniform   ? statistics.largest
         : shape == NoiseShape::laplace ? statistics.sum_absolute
                                        : statistics.sum_square;
}

ShapeEvidence shape_evidence(const LevelIntegral& integral, const TableStatistics& statistics,
                             std::size_t count, double& best) {
  const std::vector<double>& sums = sums_for(integral.shape, statistics);
  ShapeEvidence result{integral.shape, sums, {}};
  make_logarithms(result.logs);
  for (std::size_t row = 0; row < statistics.rows(); ++row)
    result.logs[row] = integral.constant - integral.order * result.logs[row] - statistics.sum_log_scale[row];
  for (std::size_t row = 0; row < statistics.rows(); ++row) {
    double& value = result.logs[row];
    if (std::isnan(statistics.sum_absolute[row])) {
      value = kImpossible;
    } else if (sums[row] >= integral.least && sums[row] <= integral.most) {
      best = std::max(best, value);
    } else {
      const RowStatistics one = statistics.row(row);
      value = log_likelihood(integral.shape, one, count, likeliest_level(integral.shape, one, count));
      result.open.push_back(row);
    }
  }
  return result;
}

/// Works out the open rows, the one with the largest bound first, but for those that are hopeless against
/// `best`.
void close(ShapeEvidence& evidence, const TableStatistics& statistics, std::size_t count, double& best) {
  const auto likeliest =
      std::max_element(evidence.open.begin(), evidence.open.end(),
                       [&](std::size_t a, std::size_t b) { return evidence.logs[a] < evidence.logs[b]; });
  if (likeliest != evidence.open.end()) std::swap(*likeliest, evidence.open.front());
  for (const std::size_t row : evidence.open) {
    double& value = evidence.logs[row];
    value = value < best - kHopeless ? kImpossible : log_evidence(evidence.shape, statistics.row(row), count);
    best = std::max(best, value);
  }
  evidence.open.clear();
}

}  // namespace

LevelIntegral level_integral(NoiseShape shape, std::size_t count) {
  const auto n = static_cast<double>(count);
  if (shape == NoiseShape::uniform)
    return {shape, n, -n * (std::numbers::ln2 + std::log1p(-kBoundTolerance)) - std::log(n * log_range()),
            kSmallestLevel / (1.0 - kBoundTolerance), kLargestLevel * std::pow(kTail, 1.0 / n)};
  // The integral over u of exp(-n u - a exp(-power u)) is Gamma(order) a^(-order) / power.
  using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const LevelCurve unit = level_curve(shape, {1.0, 1.0, 1.0, 0.0}, count);  // its a is that of a sum of one
  const double order = n / unit.power;
  return {shape, order,
          unit.constant + std::lgamma(order) - std::log(unit.power * log_range()) - order * std::log(unit.a),
          boost::math::gamma_q_inv(order, kTail, Policy()) * std::pow(kSmallestLevel, unit.power) / unit.a,
          boost::math::gamma_p_inv(order, kTail, Policy()) * std::pow(kLargestLevel, unit.power) / unit.a};
}

std::vector<double> log_mean_evidences(std::span<const LevelIntegral> integrals,
                                       const TableStatistics& statistics, std::size_t count, double& best) {
  std::vector<ShapeEvidence> parts;
  for (const LevelIntegral& integral : integrals)
    parts.push_back(shape_evidence(integral, statistics, count, best));
  std::vector<std::vector<double>> logs;
  for (ShapeEvidence& part : parts) {
    close(part, statistics, count, best);
    logs.push_back(std::move(part.logs));
  }
  return log_mean(std::move(logs));
}

std::vector<double> log_mean(std::vector<std::vector<double>> logs) {
  if (logs.size() == 1) return std::move(logs.front());
  const std::size_t rows = logs.front().size();
  std::vector<double> largest = logs.front();
  for (const std::vector<double>& values : logs)
    for (std::size_t row = 0; row < rows; ++row) largest[row] = std::max(largest[row], values[row]);
  std::vector<double> sum(rows, 0.0);
  for (std::vector<double>& values : logs) {
    for (std::size_t row = 0; row < rows; ++row) values[row] -= largest[row];
    make_exponentials(values);
    for (std::size_t row = 0; row < rows; ++row) sum[row] += values[row];
  }
  make_logarithms(sum);
  const double log_count = std::log(static_cast<double>(logs.size()));
  for (std::size_t row = 0; row < rows; ++row)
    largest[row] = largest[row] == kImpossible ? kImpossible : largest[row] + sum[row] - log_count;
  return largest;
}

}  // namespace voussoir
