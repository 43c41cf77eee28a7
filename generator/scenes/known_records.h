#pragma once
/// @file What need not be computed: the records of the build's journal, among them an interrupted build's,
/// and the states that older databases or parts of this one give.

#include <memory>
#include <vector>

#include "database/records/journal.h"
#include "generator/scenes/reused_records.h"

namespace voussoir {

/// Where finished records are found during a build. The journal may be asked, read and appended to from
/// several threads.
class KnownRecords {
 public:
  /// A journal of records with all states of the plan, of fields with so many nodes.
  KnownRecords(Journal journal, const StatePlan& plan, Eigen::Index nodes)
      : journal_(std::move(journal)), plan_(&plan), nodes_(nodes) {}

  /// Asked after those that were added before.
  void add(std::unique_ptr<ReusedRecords> reused) { reused_.push_back(std::move(reused)); }

  Journal& journal() { return journal_; }
  const Journal& journal() const { return journal_; }

  /// All states that the database keeps are there.
  bool has_record(const RecordKey& key) const;
  /// All states are there.
  bool can_start(const RecordKey& key) const;

  /// The record as the database keeps it. Precondition: has_record(key).
  Record kept_record(const RecordKey& key, KeepField fields) const;
  /// The states that one of the older databases has of a scene. Thread-safe.
  SceneStates old_states(const RecordKey& key) const;
  /// All states. Precondition: can_start(key). Throws Failure if a field is damaged.
  SceneStates states(const RecordKey& key) const;

 private:
  Field field_of(const RecordedState& state) const;

  Journal journal_;
  const StatePlan* plan_;
  Eigen::Index nodes_;
  std::vector<std::unique_ptr<ReusedRecords>> reused_;
};

}  // namespace voussoir
