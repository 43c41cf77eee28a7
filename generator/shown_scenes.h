#pragma once
/// @file The XDMF index beside a database, of scenes that ParaView shall open.

#include <filesystem>
#include <string>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// What a database that is to be built will hold.
struct DatabaseToShow {
  const std::filesystem::path& output;
  const std::vector<RecordKey>& keys;  ///< ascending
  KeepField fields;
  const BlockLayout& layout;
};

/// The scenes of a list (parse_scene_list), of an empty one none. Throws InputError for one that the database
/// will not hold: before the build, which may take hours.
std::vector<Scene> shown_scenes(const std::string& list, const DatabaseToShow& database);

/// Why a file's index is gone that has been replaced.
std::string index_removed_in_words(const std::filesystem::path& output);

}  // namespace voussoir
