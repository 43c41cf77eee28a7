#pragma once
/// @file Rows of displacements in clusters, each row as a centre and a few bytes: bounds of sums of
/// differences.

#include <cstdint>
#include <span>
#include <vector>

#include "lookup/row_clusters.h"
#include "lookup/sketch_bounds.h"

namespace voussoir {

/// f(r) = sum |reading - r| is convex, so with a cluster's centre m and the sides s (1, -1) of the readings
///     f(r) >= f(m) - sum |r - m|         (stored: one number a row),
///     f(r) >= f(m) - sum s (r - m)       (r - m stored in steps of one byte, with what rounding took away).
/// The second is close as long as r - m is small against the noise, for then few readings change sides
/// between m and r. A cluster's rows stand in descending order of the first number, so that those ruled out
/// by it are not looked at.
class Sketches {
 public:
  /// `rows` are rows of `points` numbers [m], NaN where there is no displacement.
  Sketches(std::span<const double> rows, std::size_t points, const RowClusters& clusters);

  std::size_t clusters() const { return radius_.size(); }
  /// Of every cluster.
  std::span<const float> centres() const { return centre_; }
  std::span<const float> centre(std::size_t cluster) const {
    return std::span(centre_).subspan(cluster * stride_, stride_);
  }

  /// False if no row of the cluster has a sum within the limit; `distance` is the centre's sum.
  bool may_hold(std::size_t cluster, const SketchReadings& readings, float distance, float limit) const {
    return readings.least(distance) - limit <= radius_[cluster];
  }

  /// Appends rows of a cluster, among them all whose sum is not above the limit, with bounds of their sums.
  void append_within(SketchReadings& readings, std::size_t cluster, float distance, float limit,
                     std::vector<RowBound>& found) const;

  /// Asks the processor to fetch what append_within will look at first.
  void expect(std::size_t cluster) const;

  std::size_t bytes() const;

 private:
  void add_cluster(std::span<const double> rows, std::size_t points, std::span<const std::size_t> members);
  void add_sketch(std::size_t row, std::span<const double> difference, double distance);

  std::size_t stride_;                   // points and what fills them up
  std::vector<float> centre_;            // clusters x stride [m]
  std::vector<float> radius_;            // [m] of each cluster
  std::vector<std::size_t> first_slot_;  // of each cluster, and the end of the last
  // One value a slot; the last slots of a cluster's last group are empty.
  std::vector<std::uint32_t> row_;
  std::vector<float> distance_;  // [m] from the centre, rounded up; -infinity in empty slots
  std::vector<float> step_;      // [m]
  std::vector<float> start_;     // [m] see SketchCluster; infinity in empty slots
  std::vector<std::int8_t> sketch_;
};

}  // namespace voussoir
