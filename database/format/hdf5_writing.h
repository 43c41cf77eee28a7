#pragma once
/// @file Creating an HDF5 file's groups, attributes and datasets.

#include <filesystem>

#include "core/error.h"
#include "database/format/dataset_value.h"
#include "database/format/hdf5_handle.h"

namespace voussoir {

/// An HDF5 file being written. The caller holds lock_hdf5() as long as it exists. Members throw Failure.
class Hdf5Output {
 public:
  explicit Hdf5Output(const std::filesystem::path& path);

  void add_text_attribute(const char* name, const std::string& text);
  void add_int_attribute(const char* name, int number);
  /// A contiguous dataset at a multiple of 8 bytes, with `units` and `meaning` as attributes.
  void add_dataset(const DatasetValue& value);
  /// `value` without bytes, states x rows x nodes x 2 displacements: one compressed chunk for each row of
  /// each state, to be filled by add_chunk.
  Hdf5Handle add_field_dataset(const DatasetValue& value);
  void add_chunk(const Hdf5Handle& field_dataset, std::uint64_t state, std::uint64_t row, ByteView packed);
  /// A virtual dataset, nodes x 3: row `row`, in the first state, of the displacements of this shape at
  /// `path` in `database` (a file in the same folder), z zero.
  void add_field_view(const std::string& name, const std::string& database, const char* path,
                      const std::vector<std::uint64_t>& shape, std::uint64_t row);
  /// Hands everything to the operating system.
  void close();

 private:
  void ensure_group(const std::string& dataset_path);
  void describe(const Hdf5Handle& object, const std::string& units, const std::string& meaning);
  void check(bool ok, const std::string& what) const;

  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace voussoir
