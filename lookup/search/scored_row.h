#pragma once
/// @file What a search finds.

#include <cstddef>
#include <vector>

namespace voussoir {

/// A row of the table and its sum of differences [m], the argument of the logarithm in the paper's Eq. 1.
/// Sums order scenes as misfits do and keep apart what the logarithm's guard would merge.
struct ScoredRow {
  std::size_t row = 0;
  double sum = 0.0;

  /// Smaller sums first; of equal sums the lower row.
  friend bool operator<(const ScoredRow& a, const ScoredRow& b) {
    return a.sum != b.sum ? a.sum < b.sum : a.row < b.row;
  }
  friend bool operator==(const ScoredRow&, const ScoredRow&) = default;
};

/// The `count` best of some rows, best first; impossible scenes (infinite sums) are left out.
std::vector<ScoredRow> best_rows(std::vector<ScoredRow> scored, std::size_t count);

}  // namespace voussoir
