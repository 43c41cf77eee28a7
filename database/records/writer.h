#pragma once
/// @file Writing a database file, whole or not at all.

#include <filesystem>
#include <functional>

#include "core/solve/state_name.h"
#include "core/structure/model.h"
#include "database/records/model_error.h"
#include "database/records/provenance.h"
#include "database/records/record.h"
#include "database/records/sensitivities.h"
#include "database/records/shard.h"
#include "database/records/variant_parameters.h"

namespace voussoir {

/// What a database holds beside the values of its records.
struct DatabaseContent {
  Provenance provenance;
  const Model& bridge;                      ///< the nominal variant
  std::vector<VariantParameters> variants;  ///< at least the nominal one
  std::vector<RecordKey> keys;              ///< ascending, none twice; the nominal variant has some
  std::vector<std::string> states = {kBuiltState};
  KeepField fields = KeepField::yes;
  std::vector<ModelError> model_errors{};  ///< of the states; zero for those that are left out
  std::optional<Sensitivities> sensitivities{};
  std::optional<ShardStatement> shard{};  ///< nothing: the database is whole
};

struct WrittenDatabase {
  std::string digest;
  std::uintmax_t bytes = 0;
  bool had_index = false;  ///< the file that was there before had one (xdmf.h), which is removed
};

/// The record of this row of DatabaseContent::keys; called once for each row, in order.
using RecordOfRow = std::function<Record(std::size_t row)>;

/// Writes `target` by way of a file of another name beside it, which takes the place of `target` when it is
/// whole and on the disk. Throws Failure (disk full, folder not writable) and leaves an old `target` as it
/// was. The bytes written depend on the content only.
WrittenDatabase write_database(const std::filesystem::path& target, const DatabaseContent& content,
                               const RecordOfRow& record_of_row);

/// The name of that other file.
std::filesystem::path unfinished_path(const std::filesystem::path& target);

}  // namespace voussoir
