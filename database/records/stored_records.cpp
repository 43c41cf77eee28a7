#include "database/records/stored_records.h"

#include "database/format/field_codec.h"
#include "database/records/schema.h"
#include "database/records/stored_table.h"

namespace voussoir {

StoredRecords::StoredRecords(const Hdf5File& file, const Sizes& sizes) : file_(file), sizes_(sizes) {
  const bool has_fields = file.has(dataset::kField);
  for (const Column& column : record_columns()) {
    const bool missing = column.of_fields() ? !has_fields : column.optional && !file.has(column.path);
    const bool packed = column.form == Form::packed;
    columns_.push_back(missing || packed ? ByteView{} : read_column(file, column, sizes));
    if (packed && !missing) fields_ = file.open_chunked(column.path, shape_of(column, sizes));
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
  return column.form == Form::packed ? fields_.chunks.empty() : columns_[number_of(column)].empty();
}

/// A record's values of a column.
Bytes StoredRecords::values(const Column& column, std::size_t row, std::size_t state) const {
  if (column.form == Form::packed) return packed_field(row, state);
  const std::size_t size = row_size(column, sizes_);
  const std::size_t place = column.of_state() ? state * sizes_.records + row : row;
  const ByteView whole = columns_[number_of(column)];
  auto read = read_row(column, whole.subspan(place * size, size));
  if (!read) file_.refuse(fmt::format("dataset '{}' is damaged in row {}", column.path, row));
  return std::move(*read);
}

Bytes StoredRecords::packed_field(std::size_t row, std::size_t state) const {
  const ByteView stored = fields_.chunks.at(state * sizes_.records + row);
  if (stored.empty() || stored.size() > most_packed_bytes(static_cast<Eigen::Index>(sizes_.nodes)))
    file_.refuse(fmt::format("the field of row {} is missing or too large", row));
  return {stored.begin(), stored.end()};
}

Field StoredRecords::field(std::size_t row, std::size_t state) const {
  auto field = unpack_field(packed_field(row, state), static_cast<Eigen::Index>(sizes_.nodes));
  if (!field) file_.refuse(fmt::format("the field of row {} is damaged", row));
  return std::move(*field);
}

}  // namespace voussoir
