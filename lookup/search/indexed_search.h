#pragma once
/// @file Exact search under Eq. 1, faster than scoring every row: bounds from the database's search index
/// rule out nearly all rows, and only the rest are scored.

#include <array>
#include <span>
#include <vector>

#include "database/records/database.h"
#include "database/search/search_index.h"
#include "lookup/search/eligible_rows.h"
#include "lookup/search/index_bounds.h"
#include "lookup/search/scored_row.h"

namespace voussoir {

class IndexedSearch {
 public:
  /// A search among the eligible rows. Table, index and rows must outlive it; `points` are the table's.
  IndexedSearch(const SceneTable& table, const SearchIndex& index, const std::vector<StoredPoint>& points,
                const Eligible& eligible);

  struct Result {
    std::vector<ScoredRow> best;  ///< the same rows, order and sums as exhaustive_search
    std::size_t scored = 0;       ///< rows whose sum was computed; all where bounds rule out too little
  };
  Result search(std::span<const double> readings, std::size_t count) const;

 private:
  struct Query;
  struct Finds;

  void sort_out_blocks(Query& query) const;
  void find_distances(Query& query) const;
  std::vector<std::size_t> nearest_clusters(const Query& query) const;
  std::vector<std::size_t> clusters_in_reach(const Query& query,
                                             const std::vector<std::int32_t>& limits) const;
  void look_at(std::size_t cluster, const Query& query, Finds& finds) const;
  void look_at(std::span<const std::size_t> clusters, const Query& query, Finds& finds) const;
  void look_at_all(std::span<const std::size_t> clusters, const Query& query, Finds& finds) const;
  void set_limits(double limit, Finds& finds) const;
  bool is_possible(std::size_t slot, const Query& query) const;
  std::vector<ScoredRow> score(const Query& query, const Finds& finds) const;

  const SceneTable& table_;
  SearchIndex index_;
  const Eligible& eligible_;
  std::size_t most_rows_;                                 // of a cluster
  std::vector<std::array<std::size_t, 2>> point_blocks_;  // of each point; twice the same if it has one
  std::size_t blocks_ = 0;
  std::vector<UnitClusters> units_;
  std::vector<std::uint32_t> unit_;     // of each cluster
  std::vector<std::int32_t> reach_;     // of each cluster [units]: the largest distance of its rows
  std::vector<std::uint32_t> missing_;  // slots x most_missing: blocks, or kNoBlock, or kNotEligible
};

}  // namespace voussoir
