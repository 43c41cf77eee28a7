#include "generator/reused_records.h"

#include <algorithm>

#include "core/error.h"
#include "database/format/field_codec.h"

namespace voussoir {
namespace {

/// The fields of all states; nothing if one is damaged.
std::optional<std::vector<Field>> fields_of(const Record& record, const Mesh& mesh) {
  std::vector<Field> fields;
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

}  // namespace

ReusedRecords::ReusedRecords(Database old, const NewRecords& records, const RecordSource& known)
    : old_(std::move(old)), bridges_(records.bridges), fields_(records.fields) {
  const std::set<RecordKey> wanted(records.wanted.begin(), records.wanted.end());
  const auto& old_variants = old_.variants();
  for (const VariantParameters& variant : records.variants) {
    const auto same = std::ranges::find(old_variants, variant);
    const auto number = static_cast<std::int32_t>(same - old_variants.begin());
    old_variant_.push_back(same == old_variants.end() ? std::nullopt : std::optional(number));
    if (!old_variant_.back()) continue;
    const SceneTable table = old_.table(number, 0);
    for (std::size_t row = 0; row < table.rows; ++row) {
      const RecordKey key{static_cast<std::int32_t>(old_variant_.size() - 1), table.scene(row)};
      const bool useful = starts_others(key.scene) || wanted.contains(key);
      if (useful && !known.contains(key) && adopted(key)) keys_.insert(key);
    }
  }
}

/// The old database's record made into one of the new database, or nothing if it is damaged.
std::optional<Record> ReusedRecords::adopted(const RecordKey& key) const {
  try {
    const std::int32_t variant = *old_variant_[static_cast<std::size_t>(key.variant)];
    const Record record = old_.record(old_.find(variant, key.scene).value());
    const auto fields = fields_of(record, bridges_.front().mesh);
    if (!fields || !has_right_checksum(record, *fields)) return std::nullopt;
    return fits(record, key, *fields) ? record : made_new(key, record, *fields);
  } catch (const InputError&) {  // a chunk that cannot be read
    return std::nullopt;
  }
}

/// The old file may have measured at other points and numbered its variants otherwise.
bool ReusedRecords::fits(const Record& record, const RecordKey& key, std::span<const Field> fields) const {
  if (fields_ == KeepField::no || record.key != key) return false;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const Eigen::VectorXd vertical = vertical_displacements(fields[i], bridges_.front().control_points);
    const std::span numbers(vertical.data(), static_cast<std::size_t>(vertical.size()));
    if (!std::ranges::equal(std::as_bytes(numbers), view_bytes(record.states[i].vertical))) return false;
  }
  return true;
}

Record ReusedRecords::made_new(const RecordKey& key, const Record& old, std::span<const Field> fields) const {
  std::vector<Solution> solutions;
  for (std::size_t i = 0; i < fields.size(); ++i) solutions.push_back(solution_of(old.states[i], fields[i]));
  const KeepField keep = starts_others(key.scene) ? KeepField::yes : fields_;
  return make_record(key, solutions, bridges_.front().control_points, keep, fields_);
}

Record ReusedRecords::read(const RecordKey& key) const {
  auto record = adopted(key);
  if (!record) throw Failure(fmt::format("{}: changed while it was being read", old_.path().string()));
  return std::move(*record);
}

}  // namespace voussoir
