#pragma once
/// @file What stands under the output's name before a build.

#include <optional>

#include "database/records/database.h"

namespace voussoir {

struct ExistingDatabase {
  std::optional<Database> database;  ///< if there is a file and it can be read
  bool up_to_date = false;           ///< it holds exactly what is to be built
  bool reusable = false;             ///< its records can be taken over
  std::vector<std::string> changes;  ///< why it is not up to date, in words
};

/// What is to be built.
struct WantedDatabase {
  const Provenance& provenance;
  const std::vector<VariantParameters>& variants;
  const std::vector<RecordKey>& keys;
  std::vector<std::string> states;  ///< names
  KeepField fields;
  bool sensitivities;  ///< those of an uncertain bridge, if it stands
  std::optional<ShardStatement> shard;
  bool drop;  ///< BuildRequest::drop
};

/// Throws InputError if a database of this name would take the place of what is no file, or of the bridge
/// file that it is built from, whatever is forced.
void expect_file(const std::filesystem::path& output, const std::filesystem::path& bridge_file);

/// Looks at the file; `force` makes any file out of date and its records worthless. Throws Failure (unless
/// forced) for a file that is no database, as a build should not replace what is none of its own, and for one
/// whose valid records would be dropped, as scenes or states are no longer wanted.
ExistingDatabase examine_existing(const std::filesystem::path& output, const WantedDatabase& wanted,
                                  bool force);

}  // namespace voussoir
