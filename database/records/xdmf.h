#pragma once
/// @file Light index files with which ParaView and other readers of XDMF open a database.

#include <filesystem>
#include <optional>
#include <string>

#include "database/records/database.h"

namespace voussoir {

/// The files that make up an index.
struct IndexPaths {
  std::filesystem::path xdmf;  ///< what ParaView opens
  std::filesystem::path
      views;  ///< HDF5, one virtual dataset a scene, which shows the scene's part of the database
};

/// bridge.h5 -> bridge.xdmf and bridge.views.h5
IndexPaths index_paths(const std::filesystem::path& database);

/// Writes the index of scenes of the nominal variant in the first state: a collection of one grid for each,
/// in their order, named like them
/// ("10,4+6,4") and with the scene's row in the database as time. Each has the vector `displacement` [m] of
/// the nodes (z is zero), NaN in removed blocks. All numbers stay in the database, which is referred to by
/// its name: keep the files in one folder. Throws InputError for a scene that the database does not hold,
/// Failure if it has no fields or a file cannot be written.
void write_index(const Database& database, const std::vector<Scene>& scenes);

/// A file that has a name of the database's index and is none, if there is one: write_index would replace it.
std::optional<std::filesystem::path> in_the_way_of_index(const std::filesystem::path& database);

/// Removes the index of a database of this name, if there is one: of another file's rows it would show other
/// scenes than it names. True if there was one; files that write_index has not written stay. Throws Failure
/// if they cannot be removed.
bool remove_index(const std::filesystem::path& database);

}  // namespace voussoir
