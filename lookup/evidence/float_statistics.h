#pragma once
/// @file RowStatistics in single precision, for bounds.

#include <cstddef>
#include <vector>

#include "database/search/search_index.h"
#include "lookup/evidence/row_statistics.h"

namespace voussoir {

/// Column by column; where a product of scales leaves the range of numbers its logarithm is -infinity, which
/// is on the safe side of a bound.
struct FloatStatistics {
  std::vector<float> sum_absolute;  ///< NaN for an impossible scene, here and below
  std::vector<float> sum_square;
  std::vector<float> largest;
  std::vector<float> log_scale;  ///< sum log scale_i
};

/// Of these rows of a table, rounded as they are read. Precondition: no model error.
FloatStatistics float_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table, std::span<const std::size_t> rows);

/// Of the clusters of a search index: no more than those of any of their rows. Precondition: no model error.
FloatStatistics least_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SearchIndex& index);

}  // namespace voussoir
