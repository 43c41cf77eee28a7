#include "generator/scenes/reused_records.h"

#include <algorithm>

#include "core/error.h"
#include "core/solve/state_name.h"
#include "database/format/field_codec.h"
#include "database/records/stored_bridge.h"
#include "generator/scenes/results_key.h"

namespace voussoir {
namespace {

/// Scenes with more missing blocks may be composed where what is measured shows no difference.
constexpr int kMostSolved = 2;

/// The fields of all states, if the database has any; nothing if one is damaged.
std::optional<std::vector<Field>> fields_of(const Database& database, const Record& record,
                                            const Mesh& mesh) {
  std::vector<Field> fields;
  if (!database.has_fields()) return fields;
  for (const RecordedState& state : record.states) {
    auto field = unpack_field(state.packed_field, mesh.node_count());
    if (!field || crc32_of(state.packed_field) != state.field_crc) return std::nullopt;
    fields.push_back(std::move(*field));
  }
  return fields;
}

bool has_right_checksum(const Record& record, std::span<const Field> fields) {
  std::vector<std::span<const double>> numbers;
  for (const Field& field : fields) numbers.push_back(numbers_of(field));
  return scene_checksum(record, numbers) == record.checksum;
}

/// The load case of a stage, if the description has it.
const LoadDescription* find_load(const BridgeDescription& description, std::string_view stage) {
  const auto load =
      std::ranges::find(description.loads, stage.substr(0, stage.find('@')), &LoadDescription::name);
  return load == description.loads.end() ? nullptr : &*load;
}

/// Does the state mean the same in both? Histories always do.
bool is_same_state(const std::string& state, const BridgeDescription& now, const BridgeDescription& before) {
  const std::string_view stage = load_stage_of(state);
  if (stage.empty()) return true;
  const LoadDescription* load = find_load(now, stage);
  const LoadDescription* old_load = find_load(before, stage);
  return load != nullptr && old_load != nullptr && *load == *old_load;
}

}  // namespace

ReusedRecords::ReusedRecords(Database old, const NewRecords& records, const RecordSource& known)
    : old_(std::move(old)), bridges_(records.bridges), fields_(records.fields), plan_(records.states) {
  match_states(records.description);
  const std::set<RecordKey> wanted(records.wanted.begin(), records.wanted.end());
  const int most_starting = most_missing_of_starts(records.wanted);
  const auto& old_variants = old_.variants();
  for (const VariantParameters& variant : records.variants) {
    old_variant_.push_back(find_variant(old_variants, variant));
    if (!old_variant_.back()) continue;
    const SceneTable table = old_.table(*old_variant_.back(), 0);
    for (std::size_t row = 0; row < table.rows; ++row) {
      const RecordKey key{static_cast<std::int32_t>(old_variant_.size() - 1), table.scene(row)};
      const bool useful = (key.scene.missing() <= most_starting || wanted.contains(key)) &&
                          (same_points_ || key.scene.missing() <= kMostSolved);
      std::vector<Field> fields;
      if (useful && !known.contains(key) && old_record(key, fields)) keys_.insert(key);
    }
  }
}

void ReusedRecords::match_states(const BridgeDescription& description) {
  const BridgeDescription before = description_of(old_);
  same_points_ = points_key(description) == points_key(before);
  has_kept_ = has_all_ = true;
  for (const PlannedState& state : plan_) {
    const bool same = is_same_state(state.name, description, before);
    old_state_.push_back(same ? old_.find_state(state.name) : std::nullopt);
    has_all_ = has_all_ && old_state_.back();
    has_kept_ = has_kept_ && (old_state_.back() || !state.kept);
  }
  if (old_.has_fields()) return;
  has_all_ = false;
  has_kept_ = has_kept_ && keeps_as_it_is();
}

/// A record without fields can be taken, but nothing in it can be found anew.
bool ReusedRecords::keeps_as_it_is() const {
  std::vector<std::optional<std::size_t>> kept;
  for (const std::size_t state : kept_states(plan_)) kept.push_back(old_state_[state]);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] != i) return false;
  return fields_ == KeepField::no && kept.size() == old_.states().size() && same_points_;
}

std::vector<std::string> ReusedRecords::state_names() const {
  std::vector<std::string> names;
  for (std::size_t state = 0; state < plan_.size(); ++state)
    if (old_state_[state]) names.push_back(plan_[state].name);
  return names;
}

/// The old database's record with the fields of its states, or nothing if it is damaged.
std::optional<Record> ReusedRecords::old_record(const RecordKey& key, std::vector<Field>& fields) const {
  try {
    const std::int32_t variant = *old_variant_[static_cast<std::size_t>(key.variant)];
    Record record = old_.record(old_.find(variant, key.scene).value());
    auto found = fields_of(old_, record, bridges_.front().mesh);
    if (!found || !has_right_checksum(record, *found)) return std::nullopt;
    fields = std::move(*found);
    return record;
  } catch (const InputError&) {  // a chunk that cannot be read
    return std::nullopt;
  }
}

/// The old file may have other states and have numbered its variants otherwise.
bool ReusedRecords::fits(const Record& record, const RecordKey& key) const {
  if (fields_ == KeepField::no || record.key != key || !same_points_) return false;
  const std::vector<std::size_t> kept = kept_states(plan_);
  if (kept.size() != record.states.size()) return false;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (old_state_[kept[i]] != i) return false;
  return true;
}

Record ReusedRecords::kept_record(const RecordKey& key) const {
  std::vector<Field> fields;
  auto record = old_record(key, fields);
  if (!record) throw Failure(fmt::format("{}: changed while it was being read", old_.path().string()));
  if (fits(*record, key)) return std::move(*record);
  if (!old_.has_fields()) {  // the variant may have another number here
    record->key = key;
    record->checksum = scene_checksum(*record, {});
    return std::move(*record);
  }
  std::vector<Solution> solutions;
  for (const std::size_t state : kept_states(plan_))
    solutions.push_back(solution_of(record->states[*old_state_[state]], fields[*old_state_[state]]));
  return make_record(key, solutions, bridges_.front().control_points, fields_, fields_);
}

SceneStates ReusedRecords::states(const RecordKey& key) const {
  SceneStates states(plan_.size());
  std::vector<Field> fields;
  const auto record = keys_.contains(key) ? old_record(key, fields) : std::nullopt;
  for (std::size_t state = 0; record && state < plan_.size(); ++state)
    if (const auto old = old_state_[state]) states[state] = solution_of(record->states[*old], fields[*old]);
  return states;
}

}  // namespace voussoir
