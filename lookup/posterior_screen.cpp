#include "lookup/posterior_screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lookup/evidence.h"
#include "lookup/float_statistics.h"
#include "lookup/level_curve.h"
#include "lookup/likelihood.h"
#include "lookup/table_evidence.h"

namespace voussoir {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// What single precision takes from z: this share of z, and this much of |d| / scale besides (readings and
/// displacements are rounded by 6e-8 of their size each, and the reading's size is at most that of the error
/// and the displacement).
constexpr float kRelativeError = 1e-6F;
constexpr float kRounding = 3e-7F;
constexpr float kLogError =
    1e-2F;  // of a bound: logarithms within 1e-5 times the number of readings, sums of logarithms
constexpr float kLeastSum = 1e-30F;

/// An upper bound of a shape's log evidence: constant - order log(sum) - factor sum - sum_log_scale, if sum
/// <= limit.
struct ShapeBound {
  NoiseShape shape;
  float constant;
  float order;
  float factor;
  float limit;
};

std::vector<NoiseShape> shapes_of(const NoiseModel& noise) {
  if (noise.shape != NoiseShape::automatic) return {noise.shape};
  return {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace};
}

/// At a stated level the likelihood itself; over unknown levels the integral over all of them, within range
/// or not.
ShapeBound shape_bound(NoiseShape shape, std::size_t count, bool stated) {
  if (!stated) {
    const LevelIntegral integral = level_integral(shape, count);
    return {shape, static_cast<float>(integral.constant), static_cast<float>(integral.order), 0.0F,
            kInfinity};
  }
  if (shape == NoiseShape::uniform)
    return {shape, -static_cast<float>(static_cast<double>(count) * std::numbers::ln2), 0.0F, 0.0F,
            1.0F + static_cast<float>(kBoundTolerance)};
  const LevelCurve unit = level_curve(shape, {1.0, 1.0, 1.0, 0.0}, count);
  return {shape, static_cast<float>(unit.constant), 0.0F, static_cast<float>(unit.a), kInfinity};
}

/// The shape's own statistic, with what rounding may have added taken off.
std::vector<float> least_sums(NoiseShape shape, const FloatStatistics& statistics, float count,
                              float rounding) {
  std::vector<float> sums = shape == NoiseShape::uniform   ? statistics.largest
                            : shape == NoiseShape::laplace ? statistics.sum_absolute
                                                           : statistics.sum_square;
  const float loss = shape == NoiseShape::uniform   ? rounding
                     : shape == NoiseShape::laplace ? count * rounding
                                                    : 0.0F;
  for (float& sum : sums) sum = std::max(sum * (1.0F - kRelativeError) - loss, kLeastSum);
  if (shape != NoiseShape::gaussian) return sums;
  for (float& sum :
       sums) {  // the length of the vector of errors is off by at most sqrt(count) times the rounding
    const float length = std::sqrt(sum) - std::sqrt(count) * rounding;
    sum = std::max(length > 0.0F ? length * length * (1.0F - 4.0F * kRelativeError) : 0.0F, kLeastSum);
  }
  return sums;
}

void raise_to(std::vector<float>& bounds, const ShapeBound& bound, std::vector<float> sums) {
  std::vector<float> logs = sums;
  if (bound.order > 0.0F) make_approximate_logs(logs);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const float value = bound.constant - bound.order * logs[i] - bound.factor * sums[i];
    bounds[i] = sums[i] <= bound.limit ? std::max(bounds[i], value) : bounds[i];
  }
}

bool bounds_apply(const Measurements& measurements, const NoiseModel& noise) {
  const bool own = std::any_of(measurements.sigma.begin(), measurements.sigma.end(),
                               [](double sigma) { return !std::isnan(sigma); });
  return noise.shape != NoiseShape::student && noise.model_error == 0.0 && !own &&
         (noise.relative ? *noise.relative > 0.0 : noise.floor == 0.0);
}

/// Of each row, from above, the logarithm of the largest shape's evidence; -infinity for impossible scenes.
std::vector<float> upper_bounds(const Observation& observation, const FloatStatistics& statistics,
                                const NoiseModel& noise) {
  const auto count = static_cast<float>(observation.count);
  const float rounding = kRounding / static_cast<float>(noise.relative ? *noise.relative : 1.0);
  std::vector<float> bounds(statistics.largest.size(), -kInfinity);
  for (const NoiseShape shape : shapes_of(noise))
    raise_to(bounds, shape_bound(shape, observation.count, noise.relative.has_value()),
             least_sums(shape, statistics, count, rounding));
  for (std::size_t i = 0; i < bounds.size(); ++i)
    bounds[i] =
        std::isnan(statistics.sum_absolute[i]) ? -kInfinity : bounds[i] - statistics.log_scale[i] + kLogError;
  return bounds;
}

}  // namespace

PosteriorScreen::PosteriorScreen(const SceneTable& table, const Eligible& eligible, const Prior& prior,
                                 std::size_t block_count)
    : table_(table),
      eligible_(eligible),
      prior_(prior),
      block_count_(block_count),
      stride_((table.points + kFloatLanes - 1) / kFloatLanes * kFloatLanes),
      vertical_(eligible.rows.size() * stride_, std::numeric_limits<float>::quiet_NaN()) {
  for (std::size_t i = 0; i < eligible.rows.size(); ++i) {
    const std::span<const double> row = table.row(eligible.rows[i]);
    std::transform(row.begin(), row.end(), vertical_.begin() + static_cast<std::ptrdiff_t>(i * stride_),
                   [](double value) { return static_cast<float>(value); });
  }
  const std::vector<double> by_missing = log_prior_by_missing(table, eligible, prior);
  for (const std::uint8_t missing : eligible.missing)
    log_prior_.push_back(static_cast<float>(by_missing[missing]));
}

std::vector<double> PosteriorScreen::exact_evidence(const Measurements& measurements,
                                                    std::span<const std::size_t> rows,
                                                    std::span<const double> intact,
                                                    const NoiseModel& noise) const {
  std::vector<double> vertical;
  vertical.reserve(rows.size() * table_.points);
  for (const std::size_t row : rows)
    vertical.insert(vertical.end(), table_.row(row).begin(), table_.row(row).end());
  SceneTable gathered;
  gathered.rows = rows.size();
  gathered.points = table_.points;
  gathered.vertical = vertical;
  std::vector<std::size_t> all(rows.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const std::vector<double> logs = log_evidence_of_rows(measurements, gathered, all, intact, noise);
  std::vector<double> result(table_.rows, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < rows.size(); ++i) result[rows[i]] = logs[i];
  return result;
}

std::vector<std::size_t> PosteriorScreen::rows_that_matter(const Measurements& measurements,
                                                           std::span<const double> intact,
                                                           const NoiseModel& noise) const {
  const Observation observation = observe(measurements, intact, noise, noise.relative.value_or(1.0));
  if (observation.count == 0 || !bounds_apply(measurements, noise)) return eligible_.rows;
  std::vector<float> bounds = upper_bounds(
      observation, float_statistics(observation, vertical_, eligible_.rows.size(), stride_), noise);
  std::size_t likeliest = 0;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    bounds[i] += log_prior_[i];
    if (bounds[i] > bounds[likeliest] && bounds[i] < kInfinity) likeliest = i;
  }
  const std::vector<std::size_t> one = {eligible_.rows[likeliest]};
  const double reached =
      exact_evidence(measurements, one, intact, noise)[one.front()] + log_prior_[likeliest];
  const double threshold = reached + std::log(kScreenedAway / static_cast<double>(eligible_.rows.size()));
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (bounds[i] >= threshold) rows.push_back(eligible_.rows[i]);
  return rows;
}

Posterior PosteriorScreen::operator()(const Measurements& measurements, std::span<const double> intact,
                                      const NoiseModel& noise) const {
  const std::vector<std::size_t> rows = rows_that_matter(measurements, intact, noise);
  return posterior(table_, eligible_, exact_evidence(measurements, rows, intact, noise), prior_,
                   block_count_);
}

}  // namespace voussoir
