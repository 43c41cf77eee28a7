#pragma once
/// @file Reading HDF5 files that may hold anything: every type, rank, size and place is checked before it is
/// used, and the HDF5 library takes no part (database/format/hdf5_format.h).

#include <filesystem>
#include <optional>

#include "core/error.h"
#include "database/format/dataset_value.h"
#include "database/format/hdf5_format.h"
#include "database/format/mapped_file.h"

namespace voussoir {

/// A contiguous dataset, in place in the mapped file.
struct DatasetView {
  std::string path;
  ElementType type;
  std::vector<std::uint64_t> shape;
  std::size_t text_width = 0;
  ByteView bytes;
};

/// One chunk for each row of each state, shuffled and deflated: fields/displacement.
struct ChunkedDataset {
  std::vector<ByteView> chunks;  ///< state after state, as they are stored, in place in the mapped file
};

/// All throwing members throw InputError naming the file, what is wrong and what was expected.
class Hdf5File {
 public:
  /// Throws Failure if the file cannot be read, InputError if it is no whole HDF5 file of the kind that
  /// build-database writes (superblock version 2 or 3, all of whose structures carry checksums).
  explicit Hdf5File(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }

  std::string text_attribute(const char* name) const;
  int int_attribute(const char* name) const;

  bool has(const char* dataset_path) const;
  DatasetView view(const char* dataset_path) const;

  /// The numbers of a dataset of rank 2 with this many columns, or of rank 1 for kFlat.
  template <class T>
  std::span<const T> numbers(const char* dataset_path, ElementType type, std::uint64_t columns) const {
    const DatasetView found = view(dataset_path);
    const bool fits =
        columns == kFlat ? found.shape.size() == 1 : found.shape.size() == 2 && found.shape[1] == columns;
    check_numbers(found, found.type == type && fits);
    return {reinterpret_cast<const T*>(found.bytes.data()), found.bytes.size() / sizeof(T)};
  }

  /// The bytes of a dataset of numbers of just this type and shape, at a multiple of 8 bytes.
  ByteView array(const char* dataset_path, ElementType type, const std::vector<std::uint64_t>& shape) const;

  /// A scalar text without its padding.
  std::string text(const char* dataset_path) const;

  /// A dataset of states x rows x nodes x 2 displacements.
  ChunkedDataset open_chunked(const char* dataset_path, const std::vector<std::uint64_t>& shape) const;

  [[noreturn]] void refuse(const std::string& why) const;
  void require(bool condition, const std::string& why) const {
    if (!condition) refuse(why);
  }

 private:
  void check_numbers(const DatasetView& found, bool expected) const;
  std::uint64_t root() const;
  const hdf5_format::StoredAttribute& attribute(const char* name) const;
  /// Address of a dataset's object header, or nothing.
  std::optional<std::uint64_t> find(const char* dataset_path) const;
  hdf5_format::ObjectHeader header_at(std::uint64_t address, const std::string& what) const;
  hdf5_format::ObjectHeader dataset_header(const char* dataset_path) const;

  std::filesystem::path path_;
  MappedFile mapped_;
  hdf5_format::ObjectHeader root_;
};

/// True if the file begins as every HDF5 file does, whole or not.
bool begins_like_hdf5(const std::filesystem::path& path);

}  // namespace voussoir
