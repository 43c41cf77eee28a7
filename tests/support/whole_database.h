#pragma once
/// @file A database's bytes, and reading everything that one has to offer.

#include <fstream>
#include <iterator>

#include "database/records/database.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir::test {

/// The bytes of a database with made-up fields and sensitivities.
inline std::string made_up_bytes(const BridgeFile& file, const std::vector<Scene>& scenes,
                                 KeepField fields = KeepField::yes) {
  const TemporaryFolder folder;
  const Model bridge = make_model(file.description);
  DatabaseContent content = made_up_content(file, bridge, scenes, fields);
  content.sensitivities = made_up_sensitivities(bridge, scenes, content.states.size());
  write_made_up_records(folder / "made-up.h5", content);
  std::ifstream stream(folder / "made-up.h5", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Reads everything; throws what the reader throws.
inline void read_all(const std::filesystem::path& path) {
  const Database database = Database::open(path);
  static_cast<void>(database.layout());
  static_cast<void>(database.mesh());
  static_cast<void>(database.point_weights());
  static_cast<void>(database.provenance());
  static_cast<void>(database.search_index());
  static_cast<void>(database.joints());
  static_cast<void>(database.variants());
  for (std::size_t state = 0; state < database.states().size(); ++state)
    static_cast<void>(database.table_if_standing(state));
  if (const Sensitivities* const sensitivities = database.sensitivities()) {
    static_cast<void>(are_factors_sound(*sensitivities));
    if (sensitivities->signals) static_cast<void>(are_signals_right(*sensitivities));
  }
  for (std::size_t row = 0; row < database.rows(); ++row) {
    static_cast<void>(database.record(row));
    const auto [variant, scene] = database.key(row);
    static_cast<void>(database.find(variant, scene));
    for (std::size_t state = 0; state < database.states().size(); ++state) {
      static_cast<void>(database.table(variant, state));
      if (database.has_fields()) static_cast<void>(database.field(row, state));
    }
  }
}

}  // namespace voussoir::test
