#include "generator/known_records.h"

#include <algorithm>

#include "core/error.h"
#include "database/format/field_codec.h"

namespace voussoir {
namespace {

std::span<const double> numbers_of(const Field& field) {
  return {field.data(), static_cast<std::size_t>(field.size())};
}

}  // namespace

std::size_t KnownRecords::reuse(Database old, const std::vector<Scene>& wanted) {
  old_ = std::move(old);
  const std::set<Scene> wanted_set(wanted.begin(), wanted.end());
  for (std::size_t row = 0; row < old_->table().rows; ++row) {
    const Scene scene = old_->table().scene(row);
    const bool useful = starts_others(scene) || wanted_set.contains(scene);
    if (useful && !journal_.contains(scene) && adopted(scene)) reusable_.insert(scene);
  }
  return reusable_.size();
}

/// The old database's record made into one of the new database, or nothing if it is damaged.
std::optional<Record> KnownRecords::adopted(const Scene& scene) const {
  const auto row = old_->find(scene);
  if (!row) return std::nullopt;
  try {
    const Record record = old_->record(*row);
    const auto field = unpack_field(record.packed_field, bridge_->mesh.node_count());
    if (!field || scene_checksum(record, numbers_of(*field)) != record.checksum) return std::nullopt;
    if (fields_ == KeepField::yes && has_control_points_of(record, *field)) return record;
    const KeepField keep = starts_others(scene) ? KeepField::yes : fields_;
    return make_record(scene, solution_of(record, *field), bridge_->control_points, keep, fields_);
  } catch (const InputError&) {  // a chunk that cannot be read
    return std::nullopt;
  }
}

/// The old file may have measured at other points.
bool KnownRecords::has_control_points_of(const Record& record, const Field& field) const {
  const Eigen::VectorXd vertical = vertical_displacements(field, bridge_->control_points);
  const ByteView bytes = std::as_bytes(std::span(vertical.data(), static_cast<std::size_t>(vertical.size())));
  return std::ranges::equal(bytes, view_bytes(record.vertical));
}

Record KnownRecords::read(const Scene& scene) const {
  if (journal_.contains(scene)) return journal_.read(scene);
  auto record = adopted(scene);
  if (!record) throw Failure(fmt::format("{}: changed while it was being read", old_->path().string()));
  return std::move(*record);
}

Solution KnownRecords::read_solution(const Scene& scene) const {
  const Record record = read(scene);
  const auto field = unpack_field(record.packed_field, bridge_->mesh.node_count());
  if (!field) throw Failure(fmt::format("{}: holds a damaged field; delete it", journal_.path().string()));
  return solution_of(record, *field);
}

}  // namespace voussoir
