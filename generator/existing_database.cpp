#include "generator/existing_database.h"

#include "core/error.h"
#include "database/format/hdf5_file.h"

namespace voussoir {
namespace {

bool has_scenes(const Database& database, const std::vector<Scene>& wanted) {
  if (database.table().rows != wanted.size()) return false;
  for (std::size_t row = 0; row < wanted.size(); ++row)
    if (database.table().scene(row) != wanted[row]) return false;
  return true;
}

std::vector<std::string> find_changes(const Database& database, const Provenance& provenance,
                                      const std::vector<Scene>& wanted, KeepField fields) {
  std::vector<std::string> changes = differences(provenance, database.provenance());
  if (!has_scenes(database, wanted))
    changes.push_back(
        fmt::format("other scenes are wanted ({}, was {})", wanted.size(), database.table().rows));
  if (database.has_fields() != (fields == KeepField::yes))
    changes.push_back(fields == KeepField::yes ? "fields are wanted" : "fields are no longer wanted");
  return changes;
}

}  // namespace

ExistingDatabase examine_existing(const std::filesystem::path& output, const Provenance& provenance,
                                  const std::vector<Scene>& wanted, KeepField fields, bool force) {
  ExistingDatabase existing;
  if (!std::filesystem::exists(output)) return existing;
  if (force) {
    existing.changes = {"--force is given"};
    return existing;
  }
  if (!begins_like_hdf5(output))
    throw Failure(
        fmt::format("{}: exists and is no database; give another file with -o, or --force to replace it",
                    output.string()));
  try {
    existing.database = Database::open(output);
    existing.changes = find_changes(*existing.database, provenance, wanted, fields);
    existing.up_to_date = existing.changes.empty();
    existing.reusable = existing.database->has_fields() &&
                        existing.database->provenance().results_key == provenance.results_key;
  } catch (const InputError& error) {
    existing = {};
    existing.changes = {fmt::format("the old file cannot be used ({})", error.what())};
  }
  return existing;
}

void summarise_existing(const Database& database, BuildSummary& summary) {
  summary.outcomes = count_outcomes(database);
  summary.bytes = std::filesystem::file_size(database.path());
  summary.digest = database.digest();
}

}  // namespace voussoir
