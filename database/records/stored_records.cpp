#include "database/records/stored_records.h"

#include "database/format/field_codec.h"
#include "database/records/schema.h"
#include "database/records/stored_table.h"

namespace voussoir {
StoredRecords::StoredRecords(const Hdf5File& file, const Sizes& sizes) : file_(file), sizes_(sizes) {
  const bool has_fields = file.has(dataset::kField);
  for (const Column& column : record_columns()) {
    const bool missing = (column.of_fields() && !has_fields) || (column.optional && !file.has(column.path));
    const bool in_chunks = column.in_chunks();
    columns_.push_back(missing || in_chunks ? ByteView{} : read_column(file, column, sizes));
    chunks_.push_back(missing || !in_chunks ? ChunkedDataset{}
                                            : file.open_chunked(column.path, shape_of(column, sizes)));
  }
}

Record StoredRecords::read(std::size_t row) const {
  Record record;
  record.states.resize(sizes_.states);
  for_each_column(sizes_.states, [&](const Column& column, std::size_t state) {
    if (is_missing(column)) return;
    if (!column.set_values(record, state, values(column, row, state)))
      file_.refuse(fmt::format("dataset '{}' holds a value that does not exist in row {}", column.path, row));
  });
  return record;
}

/// What is missing stays as a record begins: without a field, solved.
bool StoredRecords::is_missing(const Column& column) const {
  return columns_[number_of(column)].empty() && chunks_[number_of(column)].chunks.empty();
}

/// A record's values of a column.
Bytes StoredRecords::values(const Column& column, std::size_t row, std::size_t state) const {
  if (column.form == Form::packed) return chunk(column, row, state);
  if (column.form == Form::compressed) {
    const Field numbers = unpacked(column, row, state);
    const ByteView bytes = std::as_bytes(numbers_of(numbers));
    return is_zero(bytes) ? Bytes{} : Bytes(bytes.begin(), bytes.end());
  }
  const std::size_t size = row_size(column, sizes_);
  const std::size_t place = column.of_state() ? state * sizes_.records + row : row;
  const ByteView whole = columns_[number_of(column)];
  auto read = read_row(column, whole.subspan(place * size, size));
  if (!read) file_.refuse(fmt::format("dataset '{}' is damaged in row {}", column.path, row));
  return std::move(*read);
}

Bytes StoredRecords::chunk(const Column& column, std::size_t row, std::size_t state) const {
  const ByteView stored = chunks_[number_of(column)].chunks.at(state * sizes_.records + row);
  if (stored.empty() || stored.size() > most_packed_bytes(pairs_in_row(column, sizes_)))
    file_.refuse(fmt::format("dataset '{}': row {} is missing or too large", column.path, row));
  return {stored.begin(), stored.end()};
}

Field StoredRecords::unpacked(const Column& column, std::size_t row, std::size_t state) const {
  auto numbers = unpack_field(chunk(column, row, state), pairs_in_row(column, sizes_));
  if (!numbers) file_.refuse(fmt::format("dataset '{}' is damaged in row {}", column.path, row));
  return std::move(*numbers);
}

Field StoredRecords::field(std::size_t row, std::size_t state) const {
  return unpacked(column_at(dataset::kField), row, state);
}

}  // namespace voussoir
