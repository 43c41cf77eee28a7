#pragma once
/// @file A database's bytes, and reading everything that one has to offer.

#include <fstream>
#include <iterator>

#include "database/records/database.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir::test {

/// The bytes of a database with made-up fields.
inline std::string made_up_bytes(const BridgeFile& file, const std::vector<Scene>& scenes,
                                 KeepField fields = KeepField::yes) {
  const TemporaryFolder folder;
  write_made_up_database(folder / "made-up.h5", file, scenes, fields);
  std::ifstream stream(folder / "made-up.h5", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Reads everything; throws what the reader throws.
inline void read_all(const std::filesystem::path& path) {
  const Database database = Database::open(path);
  const SceneTable& table = database.table();
  static_cast<void>(database.layout());
  static_cast<void>(database.mesh());
  static_cast<void>(database.provenance());
  static_cast<void>(database.search_index());
  for (std::size_t row = 0; row < table.rows; ++row) {
    static_cast<void>(database.record(row));
    static_cast<void>(database.find(table.scene(row)));
    static_cast<void>(database.variant(row));
    if (!database.has_fields()) continue;
    static_cast<void>(database.chunk_crc(row));
    static_cast<void>(database.field(row));
  }
}

}  // namespace voussoir::test
