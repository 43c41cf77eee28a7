#pragma once
/// @file The arrays of an Observation as loops over a row's points take them, several points side by side.

#include <limits>

#include "lookup/readings/noise_scale.h"
#include "lookup/readings/observation.h"

namespace voussoir {

struct PointArrays {
  const double *reading, *slope, *offset, *intact, *origin, *own_variance;
  double share_square;
  std::size_t points;
};

/// Observation and scales outlive them.
inline PointArrays point_arrays(const Observation& observation, const ErrorScales& scales) {
  return {observation.reading.data(),
          scales.slope.data(),
          scales.offset.data(),
          observation.intact.data(),
          observation.origin.data(),
          observation.own_variance.data(),
          observation.error_share * observation.error_share,
          observation.reading.size()};
}

/// Some points of a row.
struct PointLanes {
  DoubleLanes reading;    ///< NaN: none
  DoubleLanes predicted;  ///< NaN: the block is gone
  DoubleLanes origin;
  DoubleLanes instrument;  ///< noise_scale
  DoubleLanes variance;    ///< model_variance
};

/// `count` points from the i-th; `common` is the model's variance that all points of the row share.
VOUSSOIR_INLINE PointLanes point_lanes(const PointArrays& arrays, const double* prediction, std::size_t i,
                                       std::size_t count, double common) {
  const auto at = [&](const double* values) __attribute__((always_inline)) {
    return load_some<DoubleLanes>(values + i, count, std::numeric_limits<double>::quiet_NaN());
  };
  PointLanes lanes;
  lanes.reading = at(arrays.reading);
  lanes.predicted = load_some<DoubleLanes>(prediction + i, count, std::numeric_limits<double>::quiet_NaN());
  lanes.origin = at(arrays.origin);
  lanes.instrument =
      noise_scale(at(arrays.slope), at(arrays.offset), magnitude(lanes.predicted - lanes.origin));
  lanes.variance = model_variance<DoubleLanes>(at(arrays.own_variance) + common, arrays.share_square,
                                               lanes.predicted - at(arrays.intact));
  return lanes;
}

/// The places of a row of a table: what loops over places are written for.
struct StoredPlaces {
  const PointArrays& arrays;
  const double* prediction;
  double common;

  std::size_t count() const { return arrays.points; }
  VOUSSOIR_INLINE PointLanes lanes(std::size_t i, std::size_t some) const {
    return point_lanes(arrays, prediction, i, some, common);
  }
};

}  // namespace voussoir
