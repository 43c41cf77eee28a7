#pragma once
/// @file The keys of a database file's records and what searches need of them, in place in the mapped file.

#include <optional>

#include "database/format/hdf5_file.h"
#include "database/records/columns.h"
#include "database/records/scene_table.h"

namespace voussoir {

/// The bytes of a column, which is no packed one. Throws InputError unless type and shape are as described.
ByteView read_column(const Hdf5File& file, const Column& column, const Sizes& sizes);

class StoredTable {
 public:
  /// Throws InputError unless every row has a key, an outcome and an extent that exist, keys are in row_order
  /// and the nominal variant has records.
  StoredTable(const Hdf5File& file, std::size_t blocks, std::size_t points, std::size_t states,
              std::size_t variants);

  const Sizes& sizes() const { return sizes_; }
  std::size_t variants() const { return first_.size() - 1; }
  /// Precondition: variant and state exist.
  SceneTable part(std::size_t variant, std::size_t state) const;
  /// Precondition: the row exists.
  RecordKey key(std::size_t row) const;
  std::optional<std::size_t> find(std::int32_t variant, const Scene& scene) const;

 private:
  std::span<const std::int32_t> removed(std::size_t row) const;  ///< without the padding
  void read_views(const Hdf5File& file);
  void check_rows(const Hdf5File& file) const;
  void check_values(const Hdf5File& file) const;

  Sizes sizes_;
  std::span<const std::int32_t> variant_;
  std::span<const std::int32_t> removed_;
  std::span<const std::uint8_t> outcome_;
  std::span<const std::uint8_t> collapse_;
  std::span<const std::uint8_t> origin_;  ///< empty if the file has none: all are solved
  std::span<const double> vertical_;
  std::vector<std::size_t> first_;  ///< row of each variant, and one past the last row
};

}  // namespace voussoir
