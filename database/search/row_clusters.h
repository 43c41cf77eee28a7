#pragma once
/// @file Rows that are alike, put together.

#include <cstddef>
#include <span>
#include <vector>

namespace voussoir {

/// A permutation of the rows, cluster after cluster.
struct RowClusters {
  std::vector<std::size_t> order;  ///< rows
  std::vector<std::size_t> begin;  ///< of each cluster, a position in `order`; and the end of the last

  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::size_t> rows(std::size_t cluster) const {
    return std::span(order).subspan(begin[cluster], begin[cluster + 1] - begin[cluster]);
  }
};

/// Splits sets of rows in two, as k-means with k = 2 would, until none has more than `most` rows that differ;
/// then a few rounds of k-means (which may make some sets larger again) over all rows, or over the parts of
/// some ten thousand rows that the first splits made, so that n rows take a time that grows with n log n.
/// `values` are rows of `stride` finite numbers, a whole number of kFloatLanes; distances are Euclidean. The
/// same rows always give the same clusters, on any number of threads.
RowClusters cluster_rows(std::span<const float> values, std::size_t stride, std::size_t most);

}  // namespace voussoir
