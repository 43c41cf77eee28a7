#include "lookup/evidence/gaussian_screen.h"

#include <cmath>
#include <numbers>

#include "core/simd/lane_math.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/index_box.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/evidence/wide_product.h"

namespace voussoir {
namespace {

constexpr std::size_t kPlacesTried = 20;  // after which hopeless boxes are left
static_assert(kPlacesTried % kLanes == 0);

struct Question {
  const PlaceArrays& arrays;
  const SceneTable& table;
  const SearchIndex& index;
  const RowPriors& priors;
  double constant;  // of the logarithm of the density, but for squares and scales in units of the arrays
  double highest;   // that a density's logarithm can be
  double least;     // that matters
};

/// Of a box: errors against the nearest number over the largest variance, and the product of the least
/// variances.
struct GaussianSums {
  DoubleLanes square{}, variances = DoubleLanes{} + 1.0;
};

/// Adds the places from the i-th and keeps the inverse of the largest variances there.
VOUSSOIR_INLINE void add_places(const PlaceArrays& arrays, const ClusterBox& box, std::size_t i,
                                const CommonVariance& common, double* weights, GaussianSums& sums) {
  const DoubleLanes zero{}, one = DoubleLanes{} + 1.0;
  const PlaceBounds at = place_bounds(arrays, box, i, common);
  const DoubleLanes most_variance = at.most_instrument * at.most_instrument + at.most_variance;
  const DoubleLanes weight = at.has_reading ? 1.0 / most_variance : zero;
  store_some(weight, kLanes, weights + i);
  sums.square += at.has_reading ? at.error * at.error * weight : zero;
  const DoubleLanes least_variance = at.least_instrument * at.least_instrument + at.least_variance;
  const double unit = arrays.inverse_unit;
  sums.variances *= at.has_reading ? least_variance * (unit * unit) : one;
}

/// The most that the logarithm of a density can be in a box but for the squares; -infinity if no row in it
/// reaches `least`.
VOUSSOIR_INLINE double bound_of(const Question& q, const ClusterBox& box, double least, double* weights) {
  const CommonVariance common = common_variance_in(q.arrays, box);
  GaussianSums sums;
  WideProduct variances;
  for (std::size_t i = 0, step = 1; i < q.arrays.reading.size(); i += kLanes, ++step) {
    add_places(q.arrays, box, i, common, weights, sums);
    if (step % (kSafeProducts / 2) == 0) flush(sums.variances, variances);
    if (i + kLanes == kPlacesTried && q.highest - 0.5 * sum_of(sums.square) < least) return kImpossible;
  }
  flush(sums.variances, variances);
  const double bound = q.constant - 0.5 * logarithm_of(variances);
  return bound - 0.5 * sum_of(sums.square) < least ? kImpossible : bound;
}

/// NaN if a reading has no prediction; beyond `most` it may be too small.
VOUSSOIR_INLINE double sum_of_squares(const PlaceArrays& arrays, const double* weights,
                                      std::span<const double> row, double most) {
  DoubleLanes sum{};
  for (std::size_t i = 0; i < row.size(); i += kLanes) {
    const auto reading = load<DoubleLanes>(arrays.reading.data() + i);
    const std::size_t some = row.size() - i < kLanes ? row.size() - i : kLanes;
    const DoubleLanes error = reading - load_some<DoubleLanes>(row.data() + i, some, 0.0);
    sum += reading == reading ? error * error * load<DoubleLanes>(weights + i) : DoubleLanes{};
    if ((i / kLanes) % 4 == 3 && sum_of(sum) > most) break;
  }
  return sum_of(sum);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void find_rows(const Question& q, double* weights, std::vector<std::size_t>& found) {
  for (std::size_t cluster = 0; cluster < q.index.clusters(); ++cluster) {
    const double bound = bound_of(q, box_of(q.index, cluster), q.least - q.priors.cluster[cluster], weights);
    if (!(bound > kImpossible)) continue;
    for (const std::int32_t slot : q.index.row.subspan(q.index.slot(cluster), q.index.rows(cluster))) {
      const auto row = static_cast<std::size_t>(slot);
      const double left = bound + q.priors.row[row] - q.least;
      if (left >= 0.0 && sum_of_squares(q.arrays, weights, q.table.row(row), 2.0 * left) <= 2.0 * left)
        found.push_back(row);
    }
  }
}

}  // namespace

bool gaussian_screen_applies(const Observation& observation) {
  return observation.noise.shape == NoiseShape::gaussian && !observation.unknown_level &&
         !observation.has_levelling() && observation.unknown_scale == 0.0;
}

std::vector<std::size_t> rows_in_reach(const Observation& observation, const SceneTable& table,
                                       const SearchIndex& index, const RowPriors& priors, double least) {
  const ErrorScales scales = scales_at(observation, stated_level(observation));
  const PlaceArrays arrays(observation, scales, index.places);
  const auto count = static_cast<double>(observation.count);
  const double constant = -count * (0.5 * std::log(2.0 * std::numbers::pi) + std::log(scales.unit));
  double highest = constant;
  for (std::size_t i = 0; i < observation.reading.size(); ++i)
    if (!std::isnan(observation.reading[i]))
      highest -= 0.5 * std::log((scales.offset[i] * scales.offset[i] + observation.own_variance[i]) *
                                arrays.inverse_unit * arrays.inverse_unit);
  const double safe = least - kLogRoundOff * (1.0 + std::abs(least));
  std::vector<double> weights(index.places);
  std::vector<std::size_t> found;
  find_rows({arrays, table, index, priors, constant, highest, safe}, weights.data(), found);
  return found;
}

}  // namespace voussoir
