#pragma once
/// @file What an older database has that can be taken over into a new one.

#include <set>
#include <span>

#include "core/structure/model.h"
#include "database/records/database.h"
#include "database/records/record_source.h"
#include "generator/scenes/state_solving.h"

namespace voussoir {

/// What the records have to be like in the new database.
struct NewRecords {
  std::span<const Model> bridges;  ///< the variants
  std::span<const VariantParameters> variants;
  const std::vector<RecordKey>& wanted;
  KeepField fields;
  const StatePlan& states;
  const BridgeDescription& description;  ///< whose loads are those of the states
};

class ReusedRecords {
 public:
  /// Takes over, from an older database with the same results key, the states with the same
  /// history and the same load case of variants with the same parameters, of scenes that are wanted or can
  /// start others; where other points are measured what they show is read from the fields, and scenes with
  /// three and more missing blocks stay behind (results_key.h). So do records whose checksums are not right,
  /// and those that `known` has already. Without fields, records can only be taken as they are, into a
  /// database without fields that has the same states and points.
  ReusedRecords(Database old, const NewRecords& records, const RecordSource& known);

  /// The scenes of which all that the new database keeps is there.
  std::size_t size() const { return has_kept_ ? keys_.size() : 0; }
  /// The names of the states that the old database gives.
  std::vector<std::string> state_names() const;

  bool has_record(const RecordKey& key) const { return has_kept_ && keys_.contains(key); }
  bool has_states(const RecordKey& key) const { return old_.has_fields() && keys_.contains(key); }
  bool can_start(const RecordKey& key) const { return has_all_ && keys_.contains(key); }
  /// The record as the new database keeps it. Precondition: has_record(key). Throws Failure if the old file
  /// changed meanwhile.
  Record kept_record(const RecordKey& key) const;
  /// The states that the old database has of a scene.
  SceneStates states(const RecordKey& key) const;

 private:
  void match_states(const BridgeDescription& description);
  bool keeps_as_it_is() const;
  std::optional<Record> old_record(const RecordKey& key, std::vector<Field>& fields) const;
  bool fits(const Record& record, const RecordKey& key) const;

  Database old_;
  std::span<const Model> bridges_;
  KeepField fields_;
  const StatePlan& plan_;
  std::vector<std::optional<std::size_t>>
      old_state_;  ///< of each state of the plan: its number in the old database
  bool same_points_ = false;
  bool has_kept_ = false;
  bool has_all_ = false;
  std::vector<std::optional<std::int32_t>> old_variant_;  ///< of each variant: its number in the old database
  std::set<RecordKey> keys_;
};

}  // namespace voussoir
