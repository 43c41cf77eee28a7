#include "lookup/evidence/cluster_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/simd/lane_math.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/index_box.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/evidence/table_evidence.h"
#include "lookup/evidence/wide_product.h"

namespace voussoir {
namespace {

constexpr double kLeastSum = 1e-30;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The least sums of RowStatistics that a scene in the box can have, and the least of its scales.
struct BoxStatistics : RowStatistics {
  double sum_square_beyond;   ///< of what lies beyond the instruments' bounds, over the model's deviation
  double sum_log_instrument;  ///< of the instruments' scales
};

/// Running sums, lane by lane, with products in the place of sums of logarithms.
struct BoxSums {
  DoubleLanes absolute{}, square{}, largest{}, square_beyond{};
  DoubleLanes scale = DoubleLanes{} + 1.0, instrument = scale, student = scale;
  WideProduct scales{}, instruments{}, students{};

  VOUSSOIR_INLINE void flush_products() {
    flush(scale, scales);
    flush(instrument, instruments);
    flush(student, students);
  }
};

/// Adds the places from the i-th: errors against the nearest number in the box over the largest scale that
/// the box allows; the products take the least scale.
VOUSSOIR_INLINE void add_places(const PlaceArrays& view, const ClusterBox& box, std::size_t i,
                                const CommonVariance& common, BoxSums& sums) {
  const DoubleLanes zero{}, one = DoubleLanes{} + 1.0;
  const PlaceBounds at = place_bounds(view, box, i, common);
  const DoubleLanes z =
      at.has_reading ? at.error / square_root(at.most_instrument * at.most_instrument + at.most_variance)
                     : zero;
  const DoubleLanes beyond = larger(at.error - at.most_instrument, zero);
  sums.absolute += z;
  sums.square += z * z;
  sums.largest = larger(sums.largest, at.has_reading ? at.error / at.most_instrument : zero);
  // A bound without model error is felt at once.
  sums.square_beyond += at.has_reading && beyond > 0.0 ? beyond * beyond / at.most_variance : zero;
  const DoubleLanes least_scale = square_root(at.least_instrument * at.least_instrument + at.least_variance);
  sums.scale *= at.has_reading ? least_scale * view.inverse_unit : one;
  sums.instrument *= at.has_reading ? at.least_instrument * view.inverse_unit : one;
  if (view.per_student > 0.0) sums.student *= 1.0 + z * z * view.per_student;
}

/// `bounded`: a scene is impossible if one error is; then the others need not be looked at.
VOUSSOIR_INLINE BoxStatistics statistics_of(const PlaceArrays& view, const ClusterBox& box, bool bounded) {
  const CommonVariance common = common_variance_in(view, box);
  BoxSums sums;
  for (std::size_t i = 0, step = 1; i < view.reading.size(); i += kLanes, ++step) {
    add_places(view, box, i, common, sums);
    if (bounded && any(sums.square_beyond == kInfinity)) return {{}, kInfinity, 0.0};
    if (step % kSafeProducts == 0) sums.flush_products();
  }
  sums.flush_products();
  return {{sum_of(sums.absolute), sum_of(sums.square), largest_of(sums.largest), logarithm_of(sums.scales),
           logarithm_of(sums.students)},
          sum_of(sums.square_beyond),
          logarithm_of(sums.instruments)};
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect(const PlaceArrays& view, const SearchIndex& index, bool bounded, BoxStatistics* results) {
  for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster)
    results[cluster] = statistics_of(view, box_of(index, cluster), bounded);
}

double sum_for(NoiseShape shape, const BoxStatistics& box) {
  return shape == NoiseShape::uniform   ? box.largest
         : shape == NoiseShape::laplace ? box.sum_absolute
                                        : box.sum_square;
}

/// The largest that one shape's evidence can be, for the level that the statistics were taken at.
double bound_at_level(NoiseShape shape, const BoxStatistics& box, std::size_t count, double nu) {
  if (shape == NoiseShape::uniform)
    return -static_cast<double>(count) * std::numbers::ln2 - box.sum_log_instrument -
           0.5 * box.sum_square_beyond;
  if (shape == NoiseShape::student) return student_log_likelihood(box, count, nu);
  return log_likelihood(shape, box, count);
}

}  // namespace

bool cluster_bounds_apply(const Observation& observation) {
  if (observation.has_levelling() || observation.unknown_scale > 0.0) return false;
  return !observation.unknown_level || has_closed_form(observation);
}

std::vector<double> cluster_bounds(const Observation& observation, const SearchIndex& index) {
  const double level = observation.unknown_level ? 1.0 : stated_level(observation);
  const ErrorScales scales = scales_at(observation, level);
  std::vector<BoxStatistics> boxes(index.clusters());
  const bool bounded = !observation.unknown_level && observation.noise.shape == NoiseShape::uniform;
  collect(PlaceArrays(observation, scales, index.places), index, bounded, boxes.data());
  const double shift = static_cast<double>(observation.count) * std::log(scales.unit);
  std::vector<double> result(boxes.size(), kImpossible);
  for (const NoiseShape shape : shapes_of(observation.noise)) {
    const LevelIntegral integral =
        observation.unknown_level ? level_integral(shape, observation.count) : LevelIntegral{};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      BoxStatistics box = boxes[i];
      box.sum_log_scale += shift;
      box.sum_log_instrument += shift;
      const double bound =
          observation.unknown_level
              ? integral.constant - integral.order * std::log(std::max(sum_for(shape, box), kLeastSum)) -
                    box.sum_log_scale
              : bound_at_level(shape, box, observation.count, observation.noise.degrees_of_freedom);
      result[i] = std::max(result[i], bound + kLogRoundOff * (1.0 + std::abs(bound)));
    }
  }
  return result;
}

}  // namespace voussoir
