#pragma once
/// @file Whole records as a database file holds them.

#include "database/format/hdf5_file.h"
#include "database/records/columns.h"

namespace voussoir {

/// Reading is thread-safe. `file` has to outlive it.
class StoredRecords {
 public:
  /// Throws InputError unless every column that the file has to have is there with its type and shape.
  StoredRecords(const Hdf5File& file, const Sizes& sizes);

  /// Throw InputError if values are damaged. Precondition: row and state exist, and for a field that the file
  /// has fields.
  Record read(std::size_t row) const;
  Field field(std::size_t row, std::size_t state) const;

 private:
  bool is_missing(const Column& column) const;
  Bytes values(const Column& column, std::size_t row, std::size_t state) const;
  Bytes chunk(const Column& column, std::size_t row, std::size_t state) const;
  Field unpacked(const Column& column, std::size_t row, std::size_t state) const;

  const Hdf5File& file_;
  Sizes sizes_;
  std::vector<ByteView> columns_;       ///< as record_columns(); empty where the file has none or chunks
  std::vector<ChunkedDataset> chunks_;  ///< as record_columns(); without chunks where the file has none
};

}  // namespace voussoir
