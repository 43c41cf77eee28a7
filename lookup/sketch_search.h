#pragma once
/// @file Exact search under Eq. 1, faster than scoring every row: sketches of one byte for each displacement
/// bound the sums of differences from below, and only rows that the bounds cannot rule out are scored.

#include <span>
#include <vector>

#include "database/database.h"
#include "lookup/candidate.h"

namespace voussoir {

/// Points are put in segments of eight with similar displacements; each segment has its own step, and a
/// displacement is kept as the nearest whole number of steps, from 0 to 255, above the segment's base for
/// that point. With |.| of whole numbers and the sizes of what rounding took away,
///     sum |reading - d| >= sum over segments of step * (sum |byte of reading - byte of d|) - rounding,
/// also where values lie beyond the range of bytes, since drawing two numbers to an interval never parts
/// them.
class SketchIndex {
 public:
  /// Sketches of the given rows, in ascending order. The table must outlive the index.
  SketchIndex(const SceneTable& table, std::span<const std::size_t> rows, std::span<const double> intact);

  struct Result {
    std::vector<ScoredRow> best;  ///< the same rows, order and sums as exhaustive_search
    std::size_t scored = 0;       ///< rows whose sum was computed
    bool fell_back = false;       ///< the bounds ruled out too little, and all rows were scored
  };
  Result search(std::span<const double> readings, std::size_t count) const;

  std::size_t bytes() const { return bytes_.size() + row_error_.size() * sizeof(float); }

 private:
  struct Query {
    std::vector<std::uint8_t> bytes;  // zero where there is no reading
    std::vector<std::uint8_t> mask;   // 255 where there is a reading
    double error = 0.0;               // [m] what rounding took away from the readings
    double worst_row_error = 0.0;     // [m] at most, at the points with readings
  };
  Query sketch(std::span<const double> readings) const;
  double step(std::size_t place) const;

  const SceneTable& table_;
  std::vector<std::size_t> rows_;
  std::vector<std::size_t> order_;     // point in each place of a sketch; `none` where a segment is not full
  std::vector<double> base_;           // [m] of each place: the displacement whose byte is 0
  double unit_ = 0.0;                  // [m]
  std::vector<std::uint64_t> weight_;  // of each segment: its step in units
  std::vector<std::uint8_t> bytes_;    // rows x places
  std::vector<float> row_error_;       // [m] of each row: what rounding took away, at most
};

}  // namespace voussoir
