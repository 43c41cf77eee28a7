#include "database/records/writer.h"

#include <algorithm>

#include "database/format/durable_file.h"
#include "database/format/field_codec.h"
#include "database/format/hdf5_writing.h"
#include "database/records/content_digest.h"
#include "database/records/schema.h"
#include "database/search/stored_index.h"

namespace voussoir {
namespace {

/// The datasets with one row for each scene, fields excepted.
struct SceneColumns {
  std::vector<double> vertical;
  std::vector<std::int32_t> removed;
  std::vector<std::uint8_t> outcome;
  std::vector<double> residual;
  std::vector<std::int32_t> iterations;
  std::vector<std::uint8_t> collapse;
  std::vector<std::uint8_t> moving;  ///< rows x blocks
  std::vector<std::uint8_t> checksum;
  std::vector<std::uint32_t> chunk_crc;
};

std::size_t most_missing(const std::vector<Scene>& scenes) {
  std::size_t most = 1;  // a dataset without columns could not be mapped
  for (const Scene& scene : scenes) most = std::max(most, scene.removed.size());
  return most;
}

void append(const Record& record, std::size_t removed_columns, std::size_t blocks, SceneColumns& columns) {
  columns.vertical.insert(columns.vertical.end(), record.vertical.begin(), record.vertical.end());
  for (std::size_t i = 0; i < removed_columns; ++i)
    columns.removed.push_back(i < record.scene.removed.size() ? value(record.scene.removed[i]) : -1);
  columns.outcome.push_back(static_cast<std::uint8_t>(record.outcome));
  columns.residual.push_back(record.residual);
  columns.iterations.push_back(record.iterations);
  columns.collapse.push_back(static_cast<std::uint8_t>(record.extent));
  columns.moving.resize(columns.moving.size() + blocks, 0);
  for (const BlockId block : record.moving)
    columns.moving[columns.moving.size() - blocks + static_cast<std::size_t>(value(block))] = 1;
  columns.checksum.insert(columns.checksum.end(), record.checksum.begin(), record.checksum.end());
  columns.chunk_crc.push_back(crc32_of(record.packed_field));
}

void write_columns(const SceneColumns& columns, KeepField fields, Hdf5Output& output) {
  const std::size_t rows = columns.outcome.size();
  const auto per_scene = [&](const auto& values) { return values.size() / rows; };
  output.add_dataset(
      dataset_of(dataset::kVertical, ElementType::float64, columns.vertical, per_scene(columns.vertical), "m",
                 "vertical displacement of the control points, up is positive, NaN where the block "
                 "is gone"));
  output.add_dataset(dataset_of(dataset::kVariant, ElementType::int32,
                                std::vector<std::int32_t>(rows, kOnlyVariant), kFlat, "1",
                                "variant of the bridge"));
  output.add_dataset(dataset_of(dataset::kRemoved, ElementType::int32, columns.removed,
                                per_scene(columns.removed), "1",
                                "removed blocks (rows of geometry/block_index) in ascending order, then -1"));
  output.add_dataset(dataset_of(dataset::kOutcome, ElementType::uint8, columns.outcome, kFlat, "1",
                                "0 standing, 1 collapsed, 2 unresolved"));
  output.add_dataset(dataset_of(dataset::kResidual, ElementType::float64, columns.residual, kFlat, "1",
                                "standing: largest unbalanced nodal force over the largest nodal weight; "
                                "collapsed: unbalanced force over the bridge's weight"));
  output.add_dataset(dataset_of(dataset::kIterations, ElementType::int32, columns.iterations, kFlat, "1",
                                "linear systems solved, or time steps of a collapse"));
  output.add_dataset(dataset_of(dataset::kCollapse, ElementType::uint8, columns.collapse, kFlat, "1",
                                "what moves away: 0 nothing, 1 wall blocks only, 2 blocks of the arch"));
  output.add_dataset(dataset_of(dataset::kMoving, ElementType::uint8, columns.moving,
                                per_scene(columns.moving), "1",
                                "1 for each block that had moved away when the collapse was decided"));
  output.add_dataset(dataset_of(dataset::kChecksum, ElementType::uint8, columns.checksum,
                                per_scene(columns.checksum), "1", "SHA-256 of everything kept of the scene"));
  if (fields == KeepField::yes)
    output.add_dataset(dataset_of(dataset::kChunkCrc, ElementType::uint32, columns.chunk_crc, kFlat, "1",
                                  "CRC-32 of the scene's chunk of fields/displacement as it is stored"));
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

/// Takes the records row by row; fields go straight to the file, everything else is small and collected.
SceneColumns write_fields(const DatabaseContent& content, const RecordOfRow& record_of_row,
                          Hdf5Output& output) {
  Hdf5Handle fields;
  if (content.fields == KeepField::yes)
    fields = output.add_field_dataset(dataset::kField, content.scenes.size(),
                                      static_cast<std::uint64_t>(content.bridge.mesh.node_count()));
  SceneColumns columns;
  const std::size_t removed_columns = most_missing(content.scenes);
  for (std::size_t row = 0; row < content.scenes.size(); ++row) {
    const Record record = record_of_row(row);
    append(record, removed_columns, static_cast<std::size_t>(content.bridge.block_count()), columns);
    if (fields) output.add_chunk(fields, row, record.packed_field);
  }
  return columns;
}

std::string digest_of(const std::vector<DatasetValue>& shared, const SceneColumns& columns) {
  std::vector<DigestPart> parts;
  for (const DatasetValue& dataset : shared) parts.push_back({dataset.path, dataset.bytes});
  parts.push_back({dataset::kChecksum, view_bytes(columns.checksum)});
  return to_hexadecimal(content_digest(parts));
}

std::string write_content(const std::filesystem::path& path, const DatabaseContent& content,
                          const RecordOfRow& record_of_row) {
  const auto lock = lock_hdf5();
  Hdf5Output output(path);
  const auto shared = shared_datasets(content.provenance, content.bridge.layout, content.bridge.mesh,
                                      content.bridge.control_points);
  for (const DatasetValue& dataset : shared) output.add_dataset(dataset);
  const SceneColumns columns = write_fields(content, record_of_row, output);
  write_columns(columns, content.fields, output);
  for (const DatasetValue& dataset : search_datasets(columns.vertical, content.bridge.control_points.size()))
    output.add_dataset(dataset);
  std::string digest = digest_of(shared, columns);
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
    return {digest, bytes};
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw;
  }
}

}  // namespace voussoir
