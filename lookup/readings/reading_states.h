#pragma once
/// @file Which states of a database readings are compared with.

#include <optional>
#include <string>
#include <vector>

#include "database/records/database.h"
#include "lookup/readings/readings_file.h"

namespace voussoir {

struct ReadingStates {
  std::string history;
  std::size_t base = 0;                            ///< the state without loads
  std::vector<std::optional<std::size_t>> loaded;  ///< of each reading: the state under its load
};

/// The states of the wanted history. Without a wish: for absolute readings `built`, for all others `lost`, or
/// the other one where the database lacks a state. Throws InputError for a history that the database does not
/// have and, with file and line, for a load.
ReadingStates find_reading_states(const ReadingsFile& file, const Database& database,
                                  const std::optional<std::string>& history);

}  // namespace voussoir
