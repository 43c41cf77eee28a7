#pragma once
/// @file The inner loops of the search by sketches.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voussoir {

inline constexpr std::size_t kGroup = 8;          ///< rows whose bounds are worked out together
inline constexpr std::size_t kSideBySide = 4;     ///< of a row side by side
inline constexpr std::size_t kSketchPlaces = 16;  ///< points are filled up to a whole number of these

/// Sketches of rows near one centre, in descending order of their distance from it; a whole number of groups.
struct SketchCluster {
  const std::int8_t*
      steps;  ///< of each group, for each four points 4 x 8 numbers, those of the first row first
  std::span<const float> step;   ///< [m] of each row
  std::span<const float> start;  ///< [m] of each row: step * (sum of its numbers) - what rounding took away
  std::span<const float> distance;  ///< [m] of each row from the centre, at least
};

/// A row of a cluster and a bound of its sum from below [m].
struct RowBound {
  std::uint32_t row;
  float bound;
};

inline constexpr float kRoundedDown = 1.0F - 4e-6F;  // what single precision takes from sums

/// Readings as the loops want them.
class SketchReadings {
 public:
  /// NaN: no reading.
  explicit SketchReadings(std::span<const double> readings);

  /// The sum of |reading - centre| for each row of `centres` [m], over the points that have a reading. Rows
  /// have a whole number of kSketchPlaces and are finite.
  std::vector<float> distances(std::span<const float> centres) const;

  /// The sum itself is not below this if this class says that it is `distance`.
  float least(float distance) const { return distance * kRoundedDown - rounding_; }

  /// For each place 2 where the reading lies above the centre, 0 where it does not, 1 where there is none.
  /// Good until the next call.
  std::span<const std::uint8_t> sides(std::span<const float> centre);

 private:
  std::vector<float> reading_;
  std::vector<std::int32_t> is_read_;     // all bits but the sign's where there is a reading
  std::vector<std::uint8_t> above_;       // 2 where there is a reading
  std::vector<std::uint8_t> no_reading_;  // 1 where there is none
  std::vector<std::uint8_t> sides_;
  float rounding_ = 0.0F;
};

/// Appends the rows of a cluster whose bounds are not above a limit. The bound of a row is
/// `distance` - step * (sum of (side - 1) * number of steps) - what rounding took away; rows nearer to the
/// centre than distance - limit are not looked at.
void append_rows_within(const SketchCluster& cluster, SketchReadings& readings, std::span<const float> centre,
                        float distance, float limit, std::vector<RowBound>& found);

/// Where the number of steps of a row's point stands among those of all rows.
constexpr std::size_t sketch_place(std::size_t row, std::size_t point, std::size_t places) {
  return row / kGroup * kGroup * places + (point / kSideBySide * kGroup + row % kGroup) * kSideBySide +
         point % kSideBySide;
}

/// Asks the processor to fetch values that will soon be needed.
template <typename T>
void fetch(std::span<const T> values) {
  constexpr std::size_t kCacheLine = 64 / sizeof(T);
  for (std::size_t i = 0; i < values.size(); i += kCacheLine) __builtin_prefetch(values.data() + i);
}

}  // namespace voussoir
