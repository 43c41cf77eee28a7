#pragma once
/// @file A row of a table beside its readings, as loops over many noise levels take it: what no level changes
/// is worked out once, and places without a reading are left out.

#include <span>
#include <vector>

#include "lookup/evidence/point_arrays.h"
#include "lookup/readings/observation.h"

namespace voussoir {

class RowAtLevels {
 public:
  /// The observation outlives it. `scale` is that of the errors, which are zero, at places that are filled
  /// up: what adds nothing to a sum.
  RowAtLevels(const Observation& observation, double scale);

  /// From now on it is this row. Precondition: every reading has a prediction.
  void take(std::span<const double> prediction);

  const Observation& observation() const { return observation_; }
  std::size_t places() const { return reading_.size(); }  ///< with those that are filled up

  /// kLanes places from the i-th at a noise level; displacements count from the origin.
  VOUSSOIR_INLINE PointLanes lanes(std::size_t i, double level) const {
    const auto at = [&](const std::vector<double>& values) __attribute__((always_inline)) {
      return load<DoubleLanes>(values.data() + i);
    };
    return {at(reading_), at(movement_), DoubleLanes{}, level * at(slope_) + at(floor_), at(variance_)};
  }

 private:
  const Observation& observation_;
  std::vector<std::size_t> points_;  // that have a reading
  std::vector<double> reading_, movement_, slope_, floor_, variance_;
};

/// The same at one level, as StoredPlaces are at theirs.
struct LevelPlaces {
  const RowAtLevels& row;
  double level;

  std::size_t count() const { return row.places(); }
  VOUSSOIR_INLINE PointLanes lanes(std::size_t i, std::size_t) const { return row.lanes(i, level); }
};

}  // namespace voussoir
