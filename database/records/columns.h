#pragma once
/// @file The one description of what is kept of a record: its columns, with their place in the file, type,
/// shape, unit and meaning, and how each is taken from a Record and put back. Journal, writer, reader and
/// checksum follow from it; the table in database/README.md and examples/h5py are tested against it.

#include <vector>

#include "database/format/dataset_value.h"
#include "database/records/record.h"

namespace voussoir {

/// What a dataset extends over.
enum class Extent {
  states,
  records,
  most_missing,
  points,
  blocks,
  nodes,
  joints,
  components,
  checksum_bytes
};

/// How far, in one file.
struct Sizes {
  std::uint64_t states = 0;
  std::uint64_t records = 0;
  std::uint64_t most_missing = 0;  ///< largest number of removed blocks of any record, at least 1
  std::uint64_t points = 0;
  std::uint64_t blocks = 0;
  std::uint64_t nodes = 0;
  std::uint64_t joints = 0;
};

/// How a record's values stand in a row of the file.
enum class Form {
  plain,      ///< as they are
  padded,     ///< a list of numbers, then -1 up to the end of the row
  marks,      ///< a list of numbers: a 1 in the place of each in a row of zeros
  packed,     ///< the bytes that pack_field made: a compressed chunk
  compressed  ///< pairs of numbers, or none; in the file a compressed chunk, all zero where there are none
};

struct Column {
  const char* path;
  std::vector<Extent> shape;  ///< {records, ..}, or {states, records, ..} of what every state has
  Form form;
  bool in_checksum;
  bool optional;  ///< missing in a file in which all its values are zero
  const char* units;
  const char* meaning;
  ElementType type;         ///< in the file
  std::size_t value_width;  ///< [bytes] of a value in a Record
  /// The values in a record; `state` counts for columns of states only.
  ByteView (*values)(const Record& record, std::size_t state);
  /// Puts values into a record; false if the bytes are no values of this column.
  bool (*set_values)(Record& record, std::size_t state, ByteView values);

  bool of_state() const { return shape.front() == Extent::states; }
  bool of_fields() const;  ///< missing in a database without fields
  bool in_chunks() const { return form == Form::packed || form == Form::compressed; }
};

/// Columns of the record, then those of its states, in the order of checksum and journal.
const std::vector<Column>& record_columns();

/// The column's place among record_columns(). Precondition: it is one of them.
inline std::size_t number_of(const Column& column) {
  return static_cast<std::size_t>(&column - record_columns().data());
}

/// The column at this path. Precondition: there is one.
const Column& column_at(const char* path);

/// Calls visit(column, state) for every column of the record and then, state after state, for every column of
/// a state.
template <class Visit>
void for_each_column(std::size_t states, const Visit& visit) {
  for (const Column& column : record_columns())
    if (!column.of_state()) visit(column, std::size_t{0});
  for (std::size_t state = 0; state < states; ++state)
    for (const Column& column : record_columns())
      if (column.of_state()) visit(column, state);
}

std::vector<std::uint64_t> shape_of(const Column& column, const Sizes& sizes);

/// Are all bytes zero?
bool is_zero(ByteView values);

/// Bytes of a row in the file.
std::size_t row_size(const Column& column, const Sizes& sizes);

/// The same of a column in chunks, in pairs of numbers: the nodes, or the joints.
Eigen::Index pairs_in_row(const Column& column, const Sizes& sizes);

/// Fills a row of the file with a record's values. Throws std::logic_error if they do not fit into it.
void write_row(const Column& column, ByteView values, std::span<std::byte> row);

/// The values in a row of the file; nothing if it is no row of the column's form.
std::optional<Bytes> read_row(const Column& column, ByteView row);

}  // namespace voussoir
