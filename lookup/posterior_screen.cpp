#include "lookup/posterior_screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

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

const std::vector<float>& sums_of(NoiseShape shape, const FloatStatistics& statistics) {
  return shape == NoiseShape::uniform   ? statistics.largest
         : shape == NoiseShape::laplace ? statistics.sum_absolute
                                        : statistics.sum_square;
}

/// How far below a sum of `count` errors' sizes (largest, squares) the true one may be: sum - share sum -
/// loss. A vector of errors is off by e in length, at most sqrt(count) times the rounding; its square S by 2
/// e sqrt(S) <= share S + e^2 / share.
struct Loss {
  float share;
  float loss;
};
Loss loss_of(NoiseShape shape, float count, float rounding) {
  if (shape == NoiseShape::uniform) return {kRelativeError, rounding};
  if (shape == NoiseShape::laplace) return {kRelativeError, count * rounding};
  constexpr float kShare = 1e-3F;
  return {kRelativeError + kShare, count * rounding * rounding / kShare};
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void raise_to(const ShapeBound& bound, const Loss& loss, const float* sums, std::size_t count,
              float* bounds) {
  const FloatLanes none = FloatLanes{} - kInfinity, least = FloatLanes{} + kLeastSum;
  for (std::size_t i = 0; i < count; i += kFloatLanes) {
    const std::size_t size = std::min(kFloatLanes, count - i);
    FloatLanes sum{}, old{};
    load_some(sums + i, size, sum);
    load_some(bounds + i, size, old);
    sum = sum - loss.share * sum - loss.loss;
    sum = sum < least ? least : sum;  // NaN stays
    FloatLanes value = sum;
    make_approximate_logarithm(value);
    value = bound.constant - bound.order * value - bound.factor * sum;
    value = sum <= bound.limit ? value : none;
    value = value > old ? value : old;
    store_some(value, size, bounds + i);
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
    raise_to(shape_bound(shape, observation.count, noise.relative.has_value()),
             loss_of(shape, count, rounding), sums_of(shape, statistics).data(), bounds.size(),
             bounds.data());
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const bool possible = statistics.sum_absolute[i] == statistics.sum_absolute[i];
    bounds[i] = possible ? bounds[i] - statistics.log_scale[i] + kLogError : -kInfinity;
  }
  return bounds;
}

}  // namespace

PosteriorScreen::PosteriorScreen(const SceneTable& table, const Eligible& eligible, const Prior& prior,
                                 std::size_t block_count)
    : table_(table),
      eligible_(eligible),
      prior_(prior),
      block_count_(block_count),
      stride_((table.points + kFloatLanes - 1) / kFloatLanes * kFloatLanes) {
  const std::vector<double> by_missing = log_prior_by_missing(table, eligible, prior);
  for (const std::uint8_t missing : eligible.missing)
    log_prior_.push_back(static_cast<float>(by_missing[missing]));
}

void PosteriorScreen::keep_copy() {
  vertical_.assign(eligible_.rows.size() * stride_, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < eligible_.rows.size(); ++i) {
    const std::span<const double> row = table_.row(eligible_.rows[i]);
    std::transform(row.begin(), row.end(), vertical_.begin() + static_cast<std::ptrdiff_t>(i * stride_),
                   [](double value) { return static_cast<float>(value); });
  }
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

FloatStatistics PosteriorScreen::statistics(const Observation& observation) const {
  if (vertical_.empty()) return float_statistics(observation, table_, eligible_.rows);
  return float_statistics(observation, vertical_, eligible_.rows.size(), stride_);
}

std::vector<std::size_t> PosteriorScreen::rows_that_matter(const Measurements& measurements,
                                                           std::span<const double> intact,
                                                           const NoiseModel& noise, std::size_t count) const {
  const Observation observation = observe(measurements, intact, noise, noise.relative.value_or(1.0));
  if (observation.count == 0 || !bounds_apply(measurements, noise)) return eligible_.rows;
  std::vector<float> bounds = upper_bounds(observation, statistics(observation), noise);
  for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i] += log_prior_[i];
  const double threshold = least_that_matters(bounds, count, measurements, intact, noise);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (bounds[i] >= threshold && bounds[i] > -kInfinity) rows.push_back(eligible_.rows[i]);
  return rows;
}

/// Works out the `count` rows with the largest bounds: what is below all of them, or far below the best of
/// them, does not matter.
double PosteriorScreen::least_that_matters(const std::vector<float>& bounds, std::size_t count,
                                           const Measurements& measurements, std::span<const double> intact,
                                           const NoiseModel& noise) const {
  std::vector<std::size_t> order(bounds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  order.resize(std::min(count, order.size()));
  const auto larger = [&](std::size_t a, std::size_t b) { return bounds[a] > bounds[b]; };
  std::make_heap(order.begin(), order.end(), larger);
  for (std::size_t i = order.size(); i < bounds.size(); ++i) {
    if (bounds[i] <= bounds[order.front()]) continue;
    std::pop_heap(order.begin(), order.end(), larger);
    order.back() = i;
    std::push_heap(order.begin(), order.end(), larger);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> rows;
  for (const std::size_t i : order) rows.push_back(eligible_.rows[i]);
  const std::vector<double> logs = exact_evidence(measurements, rows, intact, noise);
  double best = -std::numeric_limits<double>::infinity(), least = -best;
  for (const std::size_t i : order) {
    const double value = logs[eligible_.rows[i]] + static_cast<double>(log_prior_[i]);
    best = std::max(best, value);
    least = std::min(least, value);
  }
  return std::min(least, best + std::log(kScreenedAway / static_cast<double>(eligible_.rows.size())));
}

Posterior PosteriorScreen::operator()(const Measurements& measurements, std::span<const double> intact,
                                      const NoiseModel& noise, std::size_t count) const {
  const std::vector<std::size_t> rows = rows_that_matter(measurements, intact, noise, count);
  return posterior(table_, eligible_, exact_evidence(measurements, rows, intact, noise), prior_,
                   block_count_);
}

}  // namespace voussoir
