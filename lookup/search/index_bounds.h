#pragma once
/// @file The inner loops of searches by the search index: bounds of sums of differences in whole numbers, so
/// that nothing is lost by rounding that is not accounted for.
///
/// f(r) = sum |x - r| over the readings x is convex, so with a cluster's centre m and the sides s of the
/// readings (1 above the centre, else -1)
///     f(r) >= f(m) - sum |r - m|        (stored: one number a row),
///     f(r) >= f(m) - sum s (r - m)      (r - m from the row's sketch, less what is lost by sketching).
/// The second is close as long as r - m is small against the noise, for then few readings change sides
/// between m and r. What passes both is compared with the readings point by point, from the sketch still.

#include <cstdint>
#include <span>
#include <vector>

#include "database/search/search_index.h"

namespace voussoir {

/// Readings in whole numbers of 2^exponent metres, cut off just beyond the largest number of a box.
struct UnitReadings {
  std::vector<std::int16_t> reading;  ///< a value for each place of the index
  std::vector<std::int16_t> is_read;  ///< 1 where there is a reading, else 0
  std::int32_t rounded = 0;           ///< at most what rounding changed, all readings together
  bool is_cut_off = false;            ///< readings beyond the largest number: sums have no bound from above
};
/// `readings` in metres, NaN where there is none.
UnitReadings round_readings(std::span<const double> readings, std::size_t places, int exponent);

/// The sum of |reading - centre| for each row of `centres`, less `rounded`: no more than the true sum.
void least_distances(const UnitReadings& readings, std::span<const std::int16_t> centres,
                     std::span<std::int32_t> distances);

/// Clusters that share a unit, one after the other.
struct UnitClusters {
  int exponent;
  double metres;  ///< of the unit
  std::size_t first, last;
};
std::vector<UnitClusters> clusters_by_unit(const SearchIndex& index);

/// How many rows the largest cluster has.
std::size_t largest_cluster(const SearchIndex& index);

inline constexpr std::int32_t kUnbounded = 1 << 30;  ///< what a sum without a bound from above is at most

/// A row by its slot in the index, and between what its sum lies [units].
struct RowBound {
  std::uint32_t slot;
  std::int32_t least;
  std::int32_t most;
};

/// Bounds of clusters' rows, one cluster after the other.
class RowBounds {
 public:
  /// No cluster of the index has more than `most_rows`.
  RowBounds(const SearchIndex& index, std::size_t most_rows)
      : index_(index), sides_(index.places), slots_(most_rows + 1), found_(most_rows + 1) {}

  /// A cluster's rows but for those whose sums are above the limit; good until the next call. `distance` is
  /// the centre's, from least_distances.
  std::span<const RowBound> within(std::size_t cluster, const UnitReadings& readings, std::int32_t distance,
                                   std::int32_t limit);

 private:
  SearchIndex index_;
  std::vector<std::uint8_t> sides_;  // of each place 2 where the reading lies above the centre, 0 where it
                                     // does not, 1 where there is none
  std::vector<std::uint32_t> slots_;
  std::vector<RowBound> found_;
};

}  // namespace voussoir
