#include "lookup/evidence/evidence_screen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/simd/lane_math.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/float_statistics.h"
#include "lookup/evidence/level_curve.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/evidence/table_evidence.h"
#include "lookup/search/index_bounds.h"

namespace voussoir {
namespace {

/// So many clusters' rows are worked out first; more if they hold too few possible scenes.
constexpr std::array<std::size_t, 2> kClustersFirst = {8, 32};
constexpr double kAllThatIsPossible = std::numeric_limits<double>::lowest();
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
    auto sum = load_some<FloatLanes>(sums + i, size, 0.0F);
    const auto old = load_some<FloatLanes>(bounds + i, size, 0.0F);
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

bool bounds_apply(const Observation& observation) {
  const NoiseModel& noise = observation.noise;
  return noise.shape != NoiseShape::student && noise.model_error == 0.0 && !observation.own_sigmas &&
         (noise.relative ? *noise.relative > 0.0 : noise.floor == 0.0);
}

/// Of each row, from above, the logarithm of the largest shape's evidence; -infinity for impossible scenes.
std::vector<float> upper_bounds(const Observation& observation, const FloatStatistics& statistics) {
  const NoiseModel& noise = observation.noise;
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

/// The sum of |reading - centre| for each cluster [m].
std::vector<double> distances_from(std::span<const double> readings, const SearchIndex& index) {
  std::vector<std::int32_t> units(index.clusters());
  std::vector<double> metres(index.clusters());
  for (const UnitClusters& unit : clusters_by_unit(index)) {
    const std::size_t count = unit.last - unit.first;
    least_distances(round_readings(readings, index.places, unit.exponent),
                    index.centre.subspan(unit.first * index.places, count * index.places),
                    std::span(units).subspan(unit.first, count));
    for (std::size_t i = unit.first; i < unit.last; ++i) metres[i] = unit.metres * units[i];
  }
  return metres;
}

/// What is below does not matter beside these evidences of some rows.
double least_beside(std::vector<double> values, std::size_t count, std::size_t rows) {
  std::partial_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count), values.end(),
                    std::greater<>());
  return std::min(values[count - 1], values.front() + std::log(kScreenedAway / static_cast<double>(rows)));
}

}  // namespace

EvidenceScreen::EvidenceScreen(const SceneTable& table, const SearchIndex& index, const Eligible& eligible,
                               const Prior& prior)
    : table_(table),
      index_(index),
      eligible_(eligible),
      log_prior_(table.rows, -kInfinity),
      cluster_log_prior_(index.clusters(), -kInfinity) {
  const std::vector<double> by_missing = log_prior_by_missing(table, eligible, prior);
  for (std::size_t i = 0; i < eligible.rows.size(); ++i)
    log_prior_[eligible.rows[i]] = static_cast<float>(by_missing[eligible.missing[i]]);
  for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster)
    for (const std::int32_t row : index.row.subspan(index.slot(cluster), index.rows(cluster)))
      cluster_log_prior_[cluster] =
          std::max(cluster_log_prior_[cluster], log_prior_[static_cast<std::size_t>(row)]);
}

/// The eligible rows of some clusters, in ascending order: as they stand in memory, one after the other.
std::vector<std::size_t> EvidenceScreen::rows_of(std::span<const std::size_t> clusters) const {
  std::vector<std::uint8_t> is_wanted(table_.rows, 0);
  for (const std::size_t cluster : clusters)
    for (const std::int32_t row : index_.row.subspan(index_.slot(cluster), index_.rows(cluster)))
      is_wanted[static_cast<std::size_t>(row)] = 1;
  std::vector<std::size_t> rows;
  for (const std::size_t row : eligible_.rows)
    if (is_wanted[row] != 0) rows.push_back(row);
  return rows;
}

std::vector<float> EvidenceScreen::with_prior(std::vector<float> of_clusters) const {
  for (std::size_t i = 0; i < of_clusters.size(); ++i) of_clusters[i] += cluster_log_prior_[i];
  return of_clusters;
}

std::vector<float> EvidenceScreen::row_bounds(const Observation& observation, const ErrorScales& scales,
                                              std::span<const std::size_t> rows) const {
  std::vector<float> bounds = upper_bounds(observation, float_statistics(observation, scales, table_, rows));
  for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i] += log_prior_[rows[i]];
  return bounds;
}

/// A value for each of the rows.
std::vector<double> EvidenceScreen::exact_evidence(const Observation& observation,
                                                   std::span<const std::size_t> rows) const {
  std::vector<double> vertical;
  vertical.reserve(rows.size() * table_.points);
  for (const std::size_t row : rows)
    vertical.insert(vertical.end(), table_.row(row).begin(), table_.row(row).end());
  SceneTable gathered;
  gathered.rows = rows.size();
  gathered.points = table_.points;
  gathered.vertical = vertical;
  std::vector<std::size_t> all(rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return log_evidence_of_rows(observation, gathered, all);
}

/// Works out the rows of the clusters nearest to the readings: what is below the `count` best of them, or far
/// below the best, does not matter.
double EvidenceScreen::least_that_matters(const Observation& observation, std::size_t count) const {
  const std::vector<double> distance = distances_from(observation.reading, index_);
  std::vector<std::size_t> clusters(distance.size());
  std::iota(clusters.begin(), clusters.end(), std::size_t{0});
  for (const std::size_t wanted : kClustersFirst) {
    const std::size_t looked_at = std::min(wanted, clusters.size());
    std::partial_sort(clusters.begin(), clusters.begin() + static_cast<std::ptrdiff_t>(looked_at),
                      clusters.end(),
                      [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
    const std::vector<std::size_t> rows = rows_of(std::span(clusters).first(looked_at));
    std::vector<double> values = exact_evidence(observation, rows);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += static_cast<double>(log_prior_[rows[i]]);
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.size() >= count) return least_beside(std::move(values), count, eligible_.rows.size());
  }
  return kAllThatIsPossible;
}

std::vector<std::size_t> EvidenceScreen::rows_that_matter(const Observation& observation,
                                                          std::size_t count) const {
  if (observation.count == 0 || !bounds_apply(observation)) return eligible_.rows;
  const ErrorScales scales = scales_at(observation, observation.noise.relative.value_or(1.0));
  const double threshold = least_that_matters(observation, count);
  const std::vector<float> of_clusters =
      with_prior(upper_bounds(observation, least_statistics(observation, scales, index_)));
  std::vector<std::size_t> clusters;
  for (std::size_t i = 0; i < of_clusters.size(); ++i)
    if (of_clusters[i] >= threshold) clusters.push_back(i);
  const std::vector<std::size_t> rows = rows_of(clusters);
  const std::vector<float> of_rows = row_bounds(observation, scales, rows);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (of_rows[i] >= threshold) result.push_back(rows[i]);
  return result;
}

std::vector<double> EvidenceScreen::operator()(const Observation& observation, std::size_t count) const {
  const std::vector<std::size_t> rows = rows_that_matter(observation, count);
  const std::vector<double> evidence = exact_evidence(observation, rows);
  std::vector<double> of_all(table_.rows, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < rows.size(); ++i) of_all[rows[i]] = evidence[i];
  return of_all;
}

}  // namespace voussoir
