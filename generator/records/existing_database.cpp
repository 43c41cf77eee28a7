#include "generator/records/existing_database.h"

#include <algorithm>

#include "core/error.h"

namespace voussoir {
namespace {

bool has_keys(const Database& database, const std::vector<RecordKey>& wanted) {
  if (database.rows() != wanted.size()) return false;
  for (std::size_t row = 0; row < wanted.size(); ++row)
    if (database.key(row) != wanted[row]) return false;
  return true;
}

bool stands_intact(const Database& database) {
  const auto row = database.find(Scene{});
  return !row || database.record(*row).states.front().outcome == Outcome::standing;
}

/// How many variants there are, or else which of their numbers differ.
std::string difference_of_variants(const std::vector<VariantParameters>& wanted,
                                   const std::vector<VariantParameters>& found) {
  if (wanted.size() != found.size())
    return fmt::format("other variants of the bridge are wanted ({}, was {})", wanted.size(), found.size());
  std::vector<std::string_view> names;
  const auto compare = [&](std::string_view name, std::vector<double> VariantParameters::*numbers) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (wanted[i].*numbers != found[i].*numbers) return names.push_back(name);
  };
  compare("Young's modulus", &VariantParameters::young_modulus);
  compare("Poisson's ratio", &VariantParameters::poisson_ratio);
  compare("density", &VariantParameters::density);
  compare("normal stiffness", &VariantParameters::normal_stiffness);
  compare("tangential stiffness", &VariantParameters::tangential_stiffness);
  compare("friction", &VariantParameters::friction_coefficient);
  return fmt::format("other values of blocks or joints are wanted ({})", fmt::join(names, ", "));
}

std::vector<std::string> find_changes(const Database& database, const WantedDatabase& wanted) {
  std::vector<std::string> changes = differences(wanted.provenance, database.provenance());
  if (database.states() != wanted.states)
    changes.push_back(fmt::format("other states are wanted ({}, was {})", fmt::join(wanted.states, ","),
                                  fmt::join(database.states(), ",")));
  if (database.variants() != wanted.variants)
    changes.push_back(difference_of_variants(wanted.variants, database.variants()));
  if (!has_keys(database, wanted.keys))
    changes.push_back(
        fmt::format("other scenes are wanted ({}, was {})", wanted.keys.size(), database.rows()));
  if (database.has_fields() != (wanted.fields == KeepField::yes))
    changes.push_back(wanted.fields == KeepField::yes ? "fields are wanted" : "fields are no longer wanted");
  if (database.shard() != wanted.shard) changes.push_back("another part of a database is wanted");
  const bool has_sensitivities = database.sensitivities() != nullptr;
  if (wanted.sensitivities != has_sensitivities && (has_sensitivities || stands_intact(database)))
    changes.push_back(wanted.sensitivities ? "sensitivities are wanted"
                                           : "sensitivities are no longer wanted");
  if (has_sensitivities && wanted.sensitivities) {
    const Sensitivities& found = *database.sensitivities();
    if (!found.signals) changes.push_back("factors of the signals are wanted");
    if (found.left.rows() > 0 && found.left.columns() == 0)
      changes.push_back("what the first order leaves of signals is wanted");
  }
  return changes;
}

/// What of a file whose records are valid is not wanted is not thrown away unasked.
void check_nothing_is_lost(const Database& database, const WantedDatabase& wanted) {
  std::size_t scenes = 0;
  std::vector<std::optional<std::int32_t>> numbers;  // under which the file's variants are wanted
  for (const VariantParameters& variant : database.variants())
    numbers.push_back(find_variant(wanted.variants, variant));
  for (std::size_t row = 0; row < database.rows(); ++row) {
    const RecordKey key = database.key(row);
    const auto number = numbers[static_cast<std::size_t>(key.variant)];
    if (!number || !std::ranges::binary_search(wanted.keys, RecordKey{*number, key.scene})) ++scenes;
  }
  std::vector<std::string> states;
  for (const std::string& state : database.states())
    if (std::ranges::find(wanted.states, state) == wanted.states.end()) states.push_back(state);
  std::vector<std::string> lost;
  if (scenes > 0 || !states.empty())
    lost.push_back(fmt::format("{} of its {} scenes{}", states.empty() ? scenes : database.rows(),
                               database.rows(),
                               states.empty() ? "" : fmt::format(" as {}", fmt::join(states, ", "))));
  if (database.has_fields() && wanted.fields == KeepField::no) lost.emplace_back("all its fields");
  if (database.sensitivities() != nullptr && !wanted.sensitivities) lost.emplace_back("its sensitivities");
  if (lost.empty()) return;
  throw Failure(
      fmt::format("{}: {} would be lost, which are still valid: ask for them, too, give another file "
                  "with -o, or --drop to let them go",
                  database.path().string(), fmt::join(lost, " and ")));
}

}  // namespace

void expect_file(const std::filesystem::path& output, const std::filesystem::path& bridge_file) {
  std::error_code none;
  if (output.empty()) throw InputError("-o: '' given, expected the name of a file");
  if (std::filesystem::exists(output, none) && !std::filesystem::is_regular_file(output, none))
    throw InputError(fmt::format("-o: {} is no file: expected the name of one", output.string()));
  if (std::filesystem::equivalent(output, bridge_file, none))
    throw InputError(fmt::format("-o: {} is the bridge file, which would be lost: expected another file",
                                 output.string()));
}

ExistingDatabase examine_existing(const std::filesystem::path& output, const WantedDatabase& wanted,
                                  bool force) {
  ExistingDatabase existing;
  if (!std::filesystem::exists(output)) return existing;
  if (force) {
    existing.changes = {"--force is given"};
    return existing;
  }
  if (!is_named_database(output))
    throw Failure(
        fmt::format("{}: exists and is no database; give another file with -o, or --force to replace it",
                    output.string()));
  try {
    existing.database = Database::open(output);
    existing.changes = find_changes(*existing.database, wanted);
    existing.up_to_date = existing.changes.empty();
    const bool is_valid = existing.database->provenance().results_key == wanted.provenance.results_key;
    const bool is_part_of_part = wanted.shard && existing.database->shard();
    existing.reusable = is_valid && existing.database->has_fields();
    if (is_valid && !is_part_of_part && !wanted.drop) check_nothing_is_lost(*existing.database, wanted);
  } catch (const InputError& error) {
    existing = {};
    existing.changes = {fmt::format("the old file cannot be used ({})", error.what())};
  }
  return existing;
}

}  // namespace voussoir
