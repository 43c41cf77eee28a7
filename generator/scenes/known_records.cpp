#include "generator/scenes/known_records.h"

#include <algorithm>

#include "core/error.h"
#include "database/format/field_codec.h"

namespace voussoir {

bool KnownRecords::has_record(const RecordKey& key) const {
  return journal_.contains(key) ||
         std::ranges::any_of(reused_, [&](const auto& reused) { return reused->has_record(key); });
}

bool KnownRecords::can_start(const RecordKey& key) const {
  return journal_.contains(key) ||
         std::ranges::any_of(reused_, [&](const auto& reused) { return reused->can_start(key); });
}

Field KnownRecords::field_of(const RecordedState& state) const {
  auto field = unpack_field(state.packed_field, nodes_);
  if (!field) throw Failure(fmt::format("{}: holds a damaged field; delete it", journal_.path().string()));
  return std::move(*field);
}

Record KnownRecords::kept_record(const RecordKey& key, KeepField fields) const {
  if (!journal_.contains(key))
    return (*std::ranges::find_if(reused_, [&](const auto& reused) { return reused->has_record(key); }))
        ->kept_record(key);
  Record record = journal_.read(key);
  if (fields == KeepField::no)  // what has slid beforehand stands beside the fields
    for (RecordedState& state : record.states) state.slipped.clear();
  const std::vector<std::size_t> kept = kept_states(*plan_);
  if (kept.size() == record.states.size()) return record;
  Record selection{key, {}, {}};
  std::vector<Field> displacements;
  for (const std::size_t state : kept) {
    selection.states.push_back(std::move(record.states.at(state)));
    if (fields == KeepField::yes) displacements.push_back(field_of(selection.states.back()));
  }
  std::vector<std::span<const double>> numbers;
  for (const Field& displacement : displacements) numbers.push_back(numbers_of(displacement));
  selection.checksum = scene_checksum(selection, numbers);
  return selection;
}

SceneStates KnownRecords::old_states(const RecordKey& key) const {
  for (const auto& reused : reused_)
    if (reused->has_states(key)) return reused->states(key);
  return SceneStates(plan_->size());
}

SceneStates KnownRecords::states(const RecordKey& key) const {
  if (!journal_.contains(key)) return old_states(key);
  SceneStates states;
  for (const RecordedState& state : journal_.read(key).states)
    states.emplace_back(solution_of(state, field_of(state)));
  return states;
}

}  // namespace voussoir
