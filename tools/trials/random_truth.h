#pragma once
/// @file A scene whose readings a benchmark asks about.

#include "core/random.h"
#include "lookup/search/eligible_rows.h"

namespace voussoir {

/// One of the rows, all those equally likely of which a displacement is known: of some scenes that fall only
/// the outcome is. Precondition: there is such a row.
inline std::size_t random_truth(const SceneTable& table, const Eligible& rows, Random& random) {
  for (;;) {
    const std::size_t row = rows.rows[random.below(static_cast<std::uint32_t>(rows.rows.size()))];
    if (table.has_displacements(row)) return row;
  }
}

}  // namespace voussoir
