#pragma once
/// @file Which rows have a displacement wherever there is a reading.

#include <cstdint>
#include <span>
#include <vector>

namespace voussoir {

/// Rows lack displacements (NaN) in few patterns, since these come from few missing blocks: readings are
/// compared with each pattern once.
class RowPatterns {
 public:
  /// `rows` are rows of `points` numbers.
  RowPatterns(std::span<const double> rows, std::size_t points);

  /// Of each pattern, zero if it lacks nothing that has a reading (not NaN).
  std::vector<std::uint64_t> lacking(std::span<const double> readings) const;
  std::size_t of(std::size_t row) const { return pattern_[row]; }

 private:
  std::size_t count_ = 0;
  std::vector<std::uint64_t> lacks_;    // words x patterns: a bit for each point
  std::vector<std::uint32_t> pattern_;  // of each row
};

}  // namespace voussoir
