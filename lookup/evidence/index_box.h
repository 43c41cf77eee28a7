#pragma once
/// @file The boxes of the search index's clusters beside an observation, as loops over places take them,
/// several side by side.

#include <cmath>
#include <limits>
#include <vector>

#include "core/simd/lanes.h"
#include "database/search/search_index.h"
#include "lookup/readings/noise_scale.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// An Observation's arrays, filled up to the places of the index.
struct PlaceArrays {
  std::vector<double> reading, slope, offset, intact, origin, own_variance;
  double share_square, common_square, inverse_unit, per_student, readings, points;

  PlaceArrays(const Observation& observation, const ErrorScales& scales, std::size_t places)
      : reading(filled(observation.reading, places, std::nan(""))),
        slope(filled(scales.slope, places, 0.0)),
        offset(filled(scales.offset, places, 1.0)),
        intact(filled(observation.intact, places, 0.0)),
        origin(filled(observation.origin, places, 0.0)),
        own_variance(filled(observation.own_variance, places, 0.0)),
        share_square(observation.error_share * observation.error_share),
        common_square(observation.error_common * observation.error_common),
        inverse_unit(1.0 / scales.unit),
        per_student(observation.noise.shape == NoiseShape::student
                        ? 1.0 / (observation.noise.degrees_of_freedom - 2.0)
                        : 0.0),
        readings(static_cast<double>(observation.count)),
        points(static_cast<double>(observation.reading.size())) {}

  static std::vector<double> filled(std::vector<double> values, std::size_t places, double filling) {
    values.resize(places, filling);
    return values;
  }
};

/// How far numbers between low and high are from zero.
struct Distances {
  DoubleLanes least, most;
};
VOUSSOIR_INLINE Distances distances(const DoubleLanes& low, const DoubleLanes& high) {
  const DoubleLanes nearest = larger(low, -high);
  return {larger(nearest, DoubleLanes{}), larger(-low, high)};
}

/// The least and largest displacements of a cluster's rows.
struct ClusterBox {
  const std::int16_t *least, *most;
  double unit;

  VOUSSOIR_INLINE DoubleLanes low(std::size_t i) const { return load<DoubleLanes>(least + i) * unit; }
  VOUSSOIR_INLINE DoubleLanes high(std::size_t i) const { return load<DoubleLanes>(most + i) * unit; }
};

inline ClusterBox box_of(const SearchIndex& index, std::size_t cluster) {
  return {index.least.data() + cluster * index.places, index.most.data() + cluster * index.places,
          std::ldexp(1.0, index.exponent[cluster])};
}

/// The variance of the model's error that all points of a scene share.
struct CommonVariance {
  double least, most;
};

/// Of the possible scenes in the box. A mean of squares over the points that a scene has, which are those
/// with readings at least, is at most the largest square.
VOUSSOIR_INLINE CommonVariance common_variance_in(const PlaceArrays& view, const ClusterBox& box) {
  if (view.common_square == 0.0) return {0.0, 0.0};
  DoubleLanes least{}, most{}, largest{};
  for (std::size_t i = 0; i < view.reading.size(); i += kLanes) {
    const auto intact = load<DoubleLanes>(view.intact.data() + i);
    const auto reading = load<DoubleLanes>(view.reading.data() + i);
    const Distances signal = distances(box.low(i) - intact, box.high(i) - intact);
    const DoubleLanes square = signal.most * signal.most;
    least += reading == reading ? signal.least * signal.least : DoubleLanes{};
    most += square;
    largest = larger(largest, square);
  }
  return {view.common_square * (sum_of(least) / view.points),
          view.common_square * smaller(largest_of(largest), sum_of(most) / view.readings)};
}

/// The least errors of rows between low and high.
VOUSSOIR_INLINE DoubleLanes least_error(const DoubleLanes& reading, const DoubleLanes& low,
                                        const DoubleLanes& high) {
  return distances(reading - high, reading - low).least;
}

/// What the rows of a box can have at the places from the i-th.
struct PlaceBounds {
  DoubleMask has_reading;
  DoubleLanes error;                              ///< the least
  DoubleLanes least_instrument, most_instrument;  ///< scales of the instruments' errors
  DoubleLanes least_variance, most_variance;      ///< of the model's own error
};

/// @param common common_variance_in the box
VOUSSOIR_INLINE PlaceBounds place_bounds(const PlaceArrays& view, const ClusterBox& box, std::size_t i,
                                         const CommonVariance& common) {
  const auto at = [&](const std::vector<double>& values) __attribute__((always_inline)) {
    return load<DoubleLanes>(values.data() + i);
  };
  const DoubleLanes reading = at(view.reading), low = box.low(i), high = box.high(i);
  const Distances movement = distances(low - at(view.origin), high - at(view.origin));
  const Distances signal = distances(low - at(view.intact), high - at(view.intact));
  const DoubleLanes slope = at(view.slope), offset = at(view.offset), own = at(view.own_variance);
  return {reading == reading,
          least_error(reading, low, high),
          noise_scale(slope, offset, movement.least),
          noise_scale(slope, offset, movement.most),
          model_variance<DoubleLanes>(own + common.least, view.share_square, signal.least),
          model_variance<DoubleLanes>(own + common.most, view.share_square, signal.most)};
}

}  // namespace voussoir
