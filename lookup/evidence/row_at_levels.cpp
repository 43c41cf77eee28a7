#include "lookup/evidence/row_at_levels.h"

#include <cmath>

#include "lookup/readings/common_variance.h"

namespace voussoir {

RowAtLevels::RowAtLevels(const Observation& observation, double scale)
    : observation_(observation), points_(observation.channels_read()) {
  const std::size_t places = (points_.size() + kLanes - 1) / kLanes * kLanes;
  reading_ = movement_ = slope_ = variance_ = std::vector<double>(places, 0.0);
  floor_.assign(places, scale);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    reading_[k] = observation.reading[points_[k]] - observation.origin[points_[k]];
    floor_[k] = observation.floor[points_[k]];
  }
}

void RowAtLevels::take(std::span<const double> prediction) {
  const double common = common_variance(observation_.intact, observation_.error_common, prediction);
  const double share_square = observation_.error_share * observation_.error_share;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const std::size_t i = points_[k];
    movement_[k] = prediction[i] - observation_.origin[i];
    slope_[k] = observation_.share[i] * (std::abs(movement_[k]) + kSmallestMovement);
    variance_[k] = model_variance(observation_.own_variance[i] + common, share_square,
                                  prediction[i] - observation_.intact[i]);
  }
}

}  // namespace voussoir
