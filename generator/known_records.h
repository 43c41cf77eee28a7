#pragma once
/// @file Records that need not be computed: those of the build's journal, among them an interrupted build's,
/// and those of other sources.

#include <memory>
#include <vector>

#include "database/records/journal.h"

namespace voussoir {

/// Where finished records are found during a build. Reading is not thread-safe, asking and appending are.
class KnownRecords : public RecordSource {
 public:
  explicit KnownRecords(Journal journal) : journal_(std::move(journal)) {}

  void add(std::unique_ptr<RecordSource> source) { others_.push_back(std::move(source)); }

  Journal& journal() { return journal_; }
  const Journal& journal() const { return journal_; }
  bool contains(const RecordKey& key) const override;
  Record read(const RecordKey& key) const override;
  /// The displacements of a scene that others start from, with its outcome, in the first state. Throws
  /// Failure if they are not those of so many nodes.
  Solution read_solution(const RecordKey& key, Eigen::Index nodes) const;

 private:
  const RecordSource* source_of(const RecordKey& key) const;

  Journal journal_;
  std::vector<std::unique_ptr<RecordSource>> others_;
};

}  // namespace voussoir
