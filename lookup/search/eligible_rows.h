#pragma once
/// @file Which rows of a database a question is about.

#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// Rows that a search may look at: their number of missing blocks is allowed, and their outcome is known.
struct Eligible {
  std::vector<std::size_t> rows;
  std::vector<std::uint8_t> missing;  ///< of each of them, how many blocks
  std::vector<std::size_t> scenes;    ///< how many of them lack 0, 1, 2... blocks
  std::size_t unresolved = 0;         ///< rows left out only because the solver gave no answer
};
Eligible eligible_rows(const SceneTable& table, const std::vector<int>& missing);

int missing_blocks(const SceneTable& table, std::size_t row);

/// The numbers of missing blocks that scenes of the table have, ascending.
std::vector<int> numbers_of_missing(const SceneTable& table);

}  // namespace voussoir
