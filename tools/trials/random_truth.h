#pragma once
/// @file A scene whose readings a benchmark asks about.

#include "core/random.h"
#include "lookup/search/eligible_rows.h"

namespace voussoir {

/// One of the rows, all equally likely. Precondition: there is one.
inline std::size_t random_truth(const Eligible& rows, Random& random) {
  return rows.rows[random.below(static_cast<std::uint32_t>(rows.rows.size()))];
}

}  // namespace voussoir
