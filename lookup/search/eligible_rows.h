#pragma once
/// @file Which rows of a database a question is about.

#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// Rows that a search may look at: their number of missing blocks is allowed, their outcome is known, and
/// what a reading would be. A scene that falls, of which no field is kept, is not what anybody reads.
struct Eligible {
  std::vector<std::size_t> rows;
  std::vector<std::uint8_t> missing;  ///< of each of them, how many blocks
  std::vector<double> scenes;         ///< how many of them lack 0, 1, 2... blocks (SceneTable::weight)
  std::vector<double> standing;       ///< and how many of these stand, or may
  std::size_t unresolved = 0;         ///< rows left out only because the solver gave no answer
  std::vector<std::size_t> fallen;  ///< of each number, rows left out only because they fall and say nothing
                                    ///< of readings
};
Eligible eligible_rows(const SceneTable& table, const std::vector<int>& missing);

int missing_blocks(const SceneTable& table, std::size_t row);

/// The numbers of missing blocks that scenes of the table have, ascending.
std::vector<int> numbers_of_missing(const SceneTable& table);

}  // namespace voussoir
