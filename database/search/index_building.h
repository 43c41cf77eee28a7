#pragma once
/// @file Making a search index.

#include "database/search/search_index.h"

namespace voussoir {

/// The index of rows of `points` displacements [m], NaN where there is none. The first row says how far each
/// point usually moves: movements count in relation to it when rows are compared. The same rows always give
/// the same index. Infinite displacements, which no solved scene has, count as none.
/// Rows without any displacement are left out.
SearchIndexData build_search_index(std::span<const double> rows, std::size_t points);

}  // namespace voussoir
