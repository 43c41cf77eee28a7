#pragma once
/// @file A number for each row of a table, where most rows have the same.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace voussoir {

/// What touches every row of a large table takes longer than the few rows that matter.
struct RowValues {
  double elsewhere;               ///< of all rows that are not listed
  std::vector<std::size_t> rows;  ///< in ascending order
  std::vector<double> values;     ///< of each of them

  double operator[](std::size_t row) const {
    const auto found = std::lower_bound(rows.begin(), rows.end(), row);
    return found != rows.end() && *found == row ? values[static_cast<std::size_t>(found - rows.begin())]
                                                : elsewhere;
  }
};

}  // namespace voussoir
