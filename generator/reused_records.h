#pragma once
/// @file Records of an older database that can be taken over into a new one.

#include <set>
#include <span>

#include "core/structure/model.h"
#include "database/records/database.h"
#include "database/records/record_source.h"

namespace voussoir {

/// What the records have to be like in the new database.
struct NewRecords {
  std::span<const Model> bridges;  ///< the variants
  std::span<const VariantParameters> variants;
  const std::vector<RecordKey>& wanted;
  KeepField fields;
};

class ReusedRecords : public RecordSource {
 public:
  /// Takes over, from an older database with the same results key and with fields, the records of variants
  /// with the same parameters that are wanted or can start others; records whose checksums are not right stay
  /// behind, and so do those that `known` has already.
  ReusedRecords(Database old, const NewRecords& records, const RecordSource& known);

  std::size_t size() const { return keys_.size(); }
  bool contains(const RecordKey& key) const override { return keys_.contains(key); }
  Record read(const RecordKey& key) const override;

 private:
  std::optional<Record> adopted(const RecordKey& key) const;
  Record made_new(const RecordKey& key, const Record& old, std::span<const Field> fields) const;
  bool fits(const Record& record, const RecordKey& key, std::span<const Field> fields) const;

  Database old_;
  std::span<const Model> bridges_;
  KeepField fields_;
  std::vector<std::optional<std::int32_t>> old_variant_;  ///< of each variant: its number in the old database
  std::set<RecordKey> keys_;
};

/// True if fields of this scene start others and are kept even if the database is to hold none.
inline bool starts_others(const Scene& scene) {
  return scene.missing() <= 1;
}

}  // namespace voussoir
