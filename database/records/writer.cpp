#include "database/records/writer.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "database/format/durable_file.h"
#include "database/format/field_codec.h"
#include "database/format/hdf5_writing.h"
#include "database/records/columns.h"
#include "database/records/content_digest.h"
#include "database/records/schema.h"
#include "database/records/xdmf.h"
#include "database/search/stored_index.h"

namespace voussoir {
namespace {

Sizes sizes_of(const DatabaseContent& content) {
  std::size_t most_missing = 1;  // a dataset without columns could not be mapped
  for (const RecordKey& key : content.keys) most_missing = std::max(most_missing, key.scene.removed.size());
  return {content.states.size(),
          content.keys.size(),
          most_missing,
          content.bridge.control_points.size(),
          content.bridge.layout.size(),
          static_cast<std::uint64_t>(content.bridge.mesh.node_count()),
          content.bridge.joints.size()};
}

/// A column's dataset without its bytes.
DatasetValue described(const Column& column, const Sizes& sizes) {
  return {column.path, column.type, shape_of(column, sizes), 0, column.units, column.meaning, {}};
}

/// The datasets of all columns, being filled row by row. Those in chunks, which are large, go straight to the
/// file.
class Columns {
 public:
  Columns(const DatabaseContent& content, Hdf5Output& output)
      : sizes_(sizes_of(content)), fields_(content.fields), output_(output) {
    for (const Column& column : record_columns()) {
      datasets_.push_back(described(column, sizes_));
      chunked_.emplace_back();
      if (is_kept(column) && !column.in_chunks())
        datasets_.back().bytes.resize(row_size(column, sizes_) * sizes_.records *
                                      (column.of_state() ? sizes_.states : 1));
    }
  }

  void put(std::size_t row, const Record& record) {
    if (record.states.size() != sizes_.states)
      throw std::logic_error(fmt::format("a record of {} states", record.states.size()));
    for_each_column(sizes_.states, [&](const Column& column, std::size_t state) {
      if (!is_kept(column)) return;
      const ByteView values = column.values(record, state);
      if (column.in_chunks()) return put_chunk(column, state, row, values);
      const std::size_t size = row_size(column, sizes_);
      const std::size_t place = column.of_state() ? state * sizes_.records + row : row;
      write_row(column, values, std::span(dataset(column).bytes).subspan(place * size, size));
    });
  }

  void write() {
    for (const Column& column : record_columns()) {
      if (column.form == Form::compressed) fill_up(column);
      if (is_kept(column) && !column.in_chunks() && !(column.optional && is_zero(dataset(column).bytes)))
        output_.add_dataset(dataset(column));
    }
  }

  ByteView bytes(const char* path) { return dataset(column_at(path)).bytes; }

 private:
  /// A dataset in chunks, made when it gets the first.
  struct Chunked {
    Hdf5Handle dataset;
    std::set<std::pair<std::size_t, std::size_t>> filled;  ///< state and row, of compressed values
  };

  bool is_kept(const Column& column) const { return !column.of_fields() || fields_ == KeepField::yes; }
  DatasetValue& dataset(const Column& column) { return datasets_[number_of(column)]; }

  void put_chunk(const Column& column, std::size_t state, std::size_t row, ByteView values) {
    if (column.form == Form::compressed && values.empty()) return;
    Chunked& chunked = chunked_[number_of(column)];
    if (!chunked.dataset) chunked.dataset = output_.add_field_dataset(dataset(column));
    if (column.form == Form::packed) return output_.add_chunk(chunked.dataset, state, row, values);
    Field pairs(2, pairs_in_row(column, sizes_));
    write_row(column, values,
              std::as_writable_bytes(std::span(pairs.data(), static_cast<std::size_t>(pairs.size()))));
    output_.add_chunk(chunked.dataset, state, row, pack_field(pairs));
    chunked.filled.emplace(state, row);
  }

  /// Readers want no gaps.
  void fill_up(const Column& column) {
    const Chunked& chunked = chunked_[number_of(column)];
    if (!chunked.dataset) return;
    const Bytes zero = pack_field(Field::Zero(2, pairs_in_row(column, sizes_)));
    for (std::size_t state = 0; state < sizes_.states; ++state)
      for (std::size_t row = 0; row < sizes_.records; ++row)
        if (!chunked.filled.contains({state, row})) output_.add_chunk(chunked.dataset, state, row, zero);
  }

  Sizes sizes_;
  KeepField fields_;
  Hdf5Output& output_;
  std::vector<DatasetValue> datasets_;  ///< as record_columns()
  std::vector<Chunked> chunked_;        ///< as record_columns()
};

/// The control displacements that searches look at in a state: of the nominal variant, whose rows come first.
std::span<const double> searched_rows(const DatabaseContent& content, std::size_t state, ByteView vertical) {
  const std::size_t points = content.bridge.control_points.size();
  const auto rows = std::ranges::count(content.keys, kNominalVariant, &RecordKey::variant);
  const std::span all(reinterpret_cast<const double*>(vertical.data()), vertical.size() / sizeof(double));
  return all.subspan(state * content.keys.size() * points, static_cast<std::size_t>(rows) * points);
}

/// An index for each history.
void write_search_indices(const DatabaseContent& content, ByteView vertical, Hdf5Output& output) {
  for (std::size_t state = 0; state < content.states.size(); ++state) {
    if (!is_history(content.states[state])) continue;
    const auto rows = searched_rows(content, state, vertical);
    for (const DatasetValue& dataset :
         search_datasets(content.states[state], rows, content.bridge.control_points.size()))
      output.add_dataset(dataset);
  }
}

void write_attributes(const Provenance& provenance, const std::string& digest, Hdf5Output& output) {
  output.add_text_attribute(attribute::kFormat, kFormatName);
  output.add_int_attribute(attribute::kSchemaVersion, kSchemaVersion);
  output.add_text_attribute(attribute::kDigest, digest);
  output.add_text_attribute(attribute::kBridgeName, provenance.bridge_name);
  output.add_text_attribute(attribute::kBridgeSha256, to_hexadecimal(sha256(provenance.bridge_text)));
  output.add_text_attribute(attribute::kProgramVersion, provenance.program_version);
  output.add_text_attribute(attribute::kCompiler, provenance.compiler);
  output.add_text_attribute(attribute::kCompileFlags, provenance.compile_flags);
  output.add_text_attribute(attribute::kSolverRevision, provenance.solver_revision);
  output.add_text_attribute(attribute::kResultsKey, provenance.results_key);
}

std::string digest_of(const std::vector<DatasetValue>& shared, ByteView checksums) {
  std::vector<DigestPart> parts;
  for (const DatasetValue& dataset : shared) parts.push_back({dataset.path, dataset.content()});
  parts.push_back({dataset::kChecksum, checksums});
  return to_hexadecimal(content_digest(parts));
}

std::string write_content(const std::filesystem::path& path, const DatabaseContent& content,
                          const RecordOfRow& record_of_row) {
  const auto lock = lock_hdf5();
  Hdf5Output output(path);
  const auto shared =
      shared_datasets(content.provenance, content.bridge, content.variants, content.states,
                      content.model_errors, content.sensitivities ? &*content.sensitivities : nullptr);
  for (const DatasetValue& dataset : shared) output.add_dataset(dataset);
  Columns columns(content, output);
  for (std::size_t row = 0; row < content.keys.size(); ++row) columns.put(row, record_of_row(row));
  columns.write();
  if (content.shard)
    output.add_dataset(
        text_dataset(dataset::kShard, to_text(*content.shard), "which part of a database this is"));
  write_search_indices(content, columns.bytes(dataset::kVertical), output);
  if (content.sensitivities)
    for (const DatasetValue& dataset : signal_datasets(*content.sensitivities)) output.add_dataset(dataset);
  std::string digest = digest_of(shared, columns.bytes(dataset::kChecksum));
  write_attributes(content.provenance, digest, output);
  output.close();
  return digest;
}

}  // namespace

std::filesystem::path unfinished_path(const std::filesystem::path& target) {
  return target.string() + ".partial.h5";
}

WrittenDatabase write_database(const std::filesystem::path& target, const DatabaseContent& content,
                               const RecordOfRow& record_of_row) {
  const std::filesystem::path unfinished = unfinished_path(target);
  try {
    const std::string digest = write_content(unfinished, content, record_of_row);
    const std::uintmax_t bytes = std::filesystem::file_size(unfinished);
    put_in_place(unfinished, target);
    return {digest, bytes, remove_index(target)};  // it showed rows of the file that was replaced
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw;
  }
}

}  // namespace voussoir
