#pragma once
/// @file Every scene scored: the oracle of all other searches.

#include <span>

#include "lookup/search/misfit.h"
#include "lookup/search/scored_row.h"

namespace voussoir {

/// The `count` rows (of those given) with the smallest misfit.
std::vector<ScoredRow> exhaustive_search(std::span<const double> readings, const SceneTable& table,
                                         std::span<const std::size_t> rows, std::size_t count);

}  // namespace voussoir
