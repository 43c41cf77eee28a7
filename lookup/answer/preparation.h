#pragma once
/// @file What does not depend on readings, for many questions to one library.

#include <mutex>
#include <optional>
#include <vector>

#include "lookup/answer/lookup_settings.h"
#include "lookup/evidence/evidence_screen.h"
#include "lookup/readings/observation.h"
#include "lookup/search/indexed_search.h"

namespace voussoir {

/// Made once; its parts when they are first needed.
class Preparation {
 public:
  /// `known`: counts_as_known. What the library looks into outlives this. Throws InputError if it has no
  /// scene with the stated numbers of missing blocks, and for a prior that leaves none possible; Failure if
  /// it has no answer for all scenes of a number.
  Preparation(const Library& library, const LookupSettings& settings, bool known);
  Preparation(const Preparation&) = delete;  // its parts look into each other
  Preparation& operator=(const Preparation&) = delete;

  const Prior& prior() const { return prior_; }
  const Eligible& eligible() const { return eligible_; }
  const EvidenceScreen& screen() const;
  std::vector<ScoredRow> smallest_misfits(const Observation& observation, std::size_t count) const;

 private:
  SceneTable table_;
  std::vector<StoredPoint> points_;
  Prior prior_;
  Eligible eligible_;
  SearchIndex index_;  // without clusters if there is none
  // Made when they are first needed.
  mutable std::mutex making_;
  mutable std::optional<EvidenceScreen> screen_;
  mutable std::optional<IndexedSearch> indexed_;
};

}  // namespace voussoir
