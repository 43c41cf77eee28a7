#pragma once
/// @file Where finished records come from: a journal, a database file.

#include "database/records/record.h"

namespace voussoir {

class RecordSource {
 public:
  virtual ~RecordSource() = default;
  virtual bool contains(const RecordKey& key) const = 0;
  /// Precondition: contains(key). Throws Failure if the record cannot be read.
  virtual Record read(const RecordKey& key) const = 0;

 protected:
  RecordSource() = default;
  RecordSource(const RecordSource&) = default;
  RecordSource& operator=(const RecordSource&) = default;
};

}  // namespace voussoir
