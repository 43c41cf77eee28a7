#pragma once
/// @file Exact search under Eq. 1, faster than scoring every row: bounds from below rule out nearly all rows,
/// and only the rest are scored.

#include <span>
#include <vector>

#include "database/database.h"
#include "lookup/candidate.h"
#include "lookup/row_patterns.h"
#include "lookup/sketches.h"

namespace voussoir {

class SketchIndex {
 public:
  /// An index of the given rows, in ascending order. `intact` says how far each point usually moves:
  /// movements count in relation to it when clusters are made. The table must outlive the index.
  SketchIndex(const SceneTable& table, std::span<const std::size_t> rows, std::span<const double> intact);

  struct Result {
    std::vector<ScoredRow> best;  ///< the same rows, order and sums as exhaustive_search
    std::size_t scored = 0;       ///< rows whose sum was computed
    bool fell_back = false;       ///< the bounds ruled out too little, and all rows were scored
  };
  Result search(std::span<const double> readings, std::size_t count) const;

  std::size_t bytes() const { return sketches_.bytes(); }

 private:
  struct Query;
  std::vector<RowBound> nearest_clusters(const Query& query) const;
  std::size_t probe(const std::vector<RowBound>& nearest, std::size_t count, Query& query) const;
  void look_at_others(const std::vector<RowBound>& nearest, Query& query) const;
  void look_at(std::size_t cluster, float limit, Query& query) const;
  void score(const RowBound& one, Query& query) const;
  std::span<const double> row(const RowBound& found) const { return table_.row(rows_[found.row]); }

  const SceneTable& table_;
  std::vector<std::size_t> rows_;
  RowPatterns patterns_;  // of rows_
  Sketches sketches_;     // of rows_
};

}  // namespace voussoir
