#pragma once
/// @file Records that need not be computed: those of an interrupted build and those of the database to be
/// replaced.

#include <optional>
#include <set>

#include "core/structure/model.h"
#include "database/records/database.h"
#include "database/records/journal.h"

namespace voussoir {

/// Where finished records are found during a build. Reading is not thread-safe, asking and appending are.
class KnownRecords {
 public:
  /// `fields` says whether the build keeps the fields of all scenes.
  KnownRecords(Journal journal, const Model& bridge, KeepField fields)
      : journal_(std::move(journal)), bridge_(&bridge), fields_(fields) {}

  /// Takes over, from an older database with the same results key and with fields, the scenes that are wanted
  /// or can start others; records whose checksum is not right stay behind. Returns how many were taken.
  std::size_t reuse(Database old, const std::vector<Scene>& wanted);

  Journal& journal() { return journal_; }
  bool contains(const Scene& scene) const { return journal_.contains(scene) || reusable_.contains(scene); }
  Record read(const Scene& scene) const;
  /// The displacements of a scene that others start from, with its outcome.
  Solution read_solution(const Scene& scene) const;

 private:
  std::optional<Record> adopted(const Scene& scene) const;
  bool has_control_points_of(const Record& record, const Field& field) const;

  Journal journal_;
  const Model* bridge_;
  KeepField fields_;
  std::optional<Database> old_;
  std::set<Scene> reusable_;
};

/// True if fields of this scene start others and are kept even if the database is to hold none.
inline bool starts_others(const Scene& scene) {
  return scene.missing() <= 1;
}

}  // namespace voussoir
