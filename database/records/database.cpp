#include "database/records/database.h"

#include <algorithm>
#include <mutex>

#include "database/format/field_codec.h"
#include "database/format/hdf5_file.h"
#include "database/records/schema.h"
#include "database/records/stored_geometry.h"
#include "database/search/stored_index.h"

namespace voussoir {
namespace {

/// Few removed blocks first, then lexicographic: the order of rows.
bool precedes(const Scene& first, const Scene& second) {
  return first.missing() != second.missing() ? first.missing() < second.missing() : first < second;
}

std::size_t columns_of_removed(const Hdf5File& file) {
  const DatasetView view = file.view(dataset::kRemoved);
  file.require(view.shape.size() == 2, "dataset 'scenes/removed' has not the expected shape");
  return view.shape[1];
}

/// Block ids in ascending order and then only -1; `blocks` is the number of blocks.
bool is_scene(std::span<const std::int32_t> ids, std::size_t blocks) {
  std::int32_t last = -1;
  bool ended = false;
  for (const std::int32_t id : ids) {
    if (id == -1) {
      ended = true;
      continue;
    }
    if (ended || id <= last || static_cast<std::size_t>(id) >= blocks) return false;
    last = id;
  }
  return true;
}

/// The same order as `precedes` on rows of `removed`: with -1 for nothing, shorter scenes come first once the
/// numbers of removed blocks are compared.
bool rows_ascend(std::span<const std::int32_t> first, std::span<const std::int32_t> second) {
  const auto free_first = std::count(first.begin(), first.end(), -1);
  const auto free_second = std::count(second.begin(), second.end(), -1);
  if (free_first != free_second) return free_first > free_second;
  return std::lexicographical_compare(first.begin(), first.end(), second.begin(), second.end());
}

void check_scenes(const Hdf5File& file, const SceneTable& table, std::size_t blocks) {
  for (std::size_t row = 0; row < table.rows; ++row) {
    const auto ids = table.removed.subspan(row * table.most_missing, table.most_missing);
    // Messages are made only when they are needed: there are many rows.
    if (!is_scene(ids, blocks))
      file.require(false, fmt::format("dataset 'scenes/removed' holds no scene in row {}", row));
    if (row > 0 &&
        !rows_ascend(table.removed.subspan((row - 1) * table.most_missing, table.most_missing), ids))
      file.require(false, fmt::format("dataset 'scenes/removed' is out of order in row {}", row));
    if (table.outcome[row] > static_cast<std::uint8_t>(Outcome::unresolved))
      file.require(false, fmt::format("dataset 'scenes/outcome' holds no outcome in row {}", row));
    if (table.collapse[row] > static_cast<std::uint8_t>(CollapseExtent::arch))
      file.require(false, fmt::format("dataset 'scenes/collapse' holds no extent in row {}", row));
  }
}

SceneTable read_table(const Hdf5File& file, std::size_t points) {
  SceneTable table;
  table.points = points;
  table.most_missing = columns_of_removed(file);
  table.removed = file.numbers<std::int32_t>(dataset::kRemoved, ElementType::int32, table.most_missing);
  table.outcome = file.numbers<std::uint8_t>(dataset::kOutcome, ElementType::uint8, kFlat);
  table.collapse = file.numbers<std::uint8_t>(dataset::kCollapse, ElementType::uint8, kFlat);
  table.vertical = file.numbers<double>(dataset::kVertical, ElementType::float64, points);
  table.rows = table.outcome.size();
  file.require(table.removed.size() == table.rows * table.most_missing &&
                   table.collapse.size() == table.rows && table.vertical.size() == table.rows * table.points,
               "the datasets of scenes/ and control/ have different numbers of scenes");
  return table;
}

void check_points(const Hdf5File& file, const std::vector<StoredPoint>& points, std::size_t blocks) {
  for (const StoredPoint& point : points)
    file.require(value(point.block) >= 0 && static_cast<std::size_t>(point.block) < blocks,
                 fmt::format("control point {} belongs to a block that does not exist", point.name));
}

void check_version(const Hdf5File& file) {
  file.require(file.text_attribute(attribute::kFormat) == kFormatName,
               "this HDF5 file is no database (expected one written by build-database)");
  const int version = file.int_attribute(attribute::kSchemaVersion);
  file.require(
      version == kSchemaVersion,
      fmt::format("schema version {} where {} was expected: build the database again with this program",
                  version, kSchemaVersion));
}

}  // namespace

Scene SceneTable::scene(std::size_t row) const {
  Scene scene;
  for (const std::int32_t id : removed.subspan(row * most_missing, most_missing))
    if (id >= 0) scene.removed.push_back(BlockId{id});
  return scene;
}

namespace {

/// What is kept of the scenes beside the table that searches use.
struct SceneColumns {
  std::span<const double> residual;
  std::span<const std::int32_t> iterations;
  std::span<const std::int32_t> variant;
  std::span<const std::uint8_t> moving;      ///< rows x blocks
  std::span<const std::uint8_t> checksum;    ///< rows x 32
  std::span<const std::uint32_t> chunk_crc;  ///< empty without fields
  bool has_fields = false;
};

/// The columns of a dataset with one row for each scene.
template <class T>
std::span<const T> read_column(const Hdf5File& file, const char* path, ElementType type, std::size_t rows,
                               std::uint64_t columns = kFlat) {
  const auto numbers = file.numbers<T>(path, type, columns);
  const std::uint64_t found = columns == kFlat ? numbers.size() : numbers.size() / columns;
  file.require(found == rows,
               fmt::format("dataset '{}' has {} rows where {} were expected", path, found, rows));
  return numbers;
}

/// The blocks that are marked in a row of scenes/moving.
std::vector<BlockId> moving_blocks(const Hdf5File& file, std::span<const std::uint8_t> marks,
                                   std::size_t rows, std::size_t row) {
  std::vector<BlockId> moving;
  const auto of_row = marks.subspan(row * (marks.size() / rows), marks.size() / rows);
  for (std::size_t b = 0; b < of_row.size(); ++b) {
    if (of_row[b] > 1)
      file.require(false, fmt::format("dataset 'scenes/moving' holds {} in row {} where 0 or 1 was expected",
                                      of_row[b], row));
    if (of_row[b] == 1) moving.push_back(BlockId{static_cast<std::int32_t>(b)});
  }
  return moving;
}

SceneColumns read_columns(const Hdf5File& file, std::size_t rows, std::size_t blocks) {
  SceneColumns columns;
  columns.residual = read_column<double>(file, dataset::kResidual, ElementType::float64, rows);
  columns.iterations = read_column<std::int32_t>(file, dataset::kIterations, ElementType::int32, rows);
  columns.variant = read_column<std::int32_t>(file, dataset::kVariant, ElementType::int32, rows);
  columns.moving = read_column<std::uint8_t>(file, dataset::kMoving, ElementType::uint8, rows, blocks);
  columns.checksum =
      read_column<std::uint8_t>(file, dataset::kChecksum, ElementType::uint8, rows, sizeof(Sha256));
  columns.has_fields = file.has(dataset::kField);
  if (columns.has_fields)
    columns.chunk_crc = read_column<std::uint32_t>(file, dataset::kChunkCrc, ElementType::uint32, rows);
  return columns;
}

}  // namespace

struct Database::Implementation {
  Hdf5File file;
  std::string digest;
  std::string bridge_name;
  std::vector<StoredPoint> points;
  SceneTable table;

  std::mutex mutex{};  ///< guards what is read on first use
  std::optional<SearchIndex> search_index{};
  std::optional<BlockLayout> layout{};
  std::optional<Mesh> mesh{};
  std::optional<SceneColumns> columns{};
  std::optional<ChunkedDataset> fields{};

  const SceneColumns& scene_columns() {
    const std::scoped_lock lock(mutex);
    if (!columns) columns = read_columns(file, table.rows, blocks());
    return *columns;
  }

  void check_row(std::size_t row) const {
    if (row >= table.rows)
      throw InputError(
          fmt::format("{}: no scene {} (0 to {} exist)", file.path().string(), row, table.rows - 1));
  }

  std::size_t blocks() const {
    return file.numbers<std::int32_t>(dataset::kBlockIndex, ElementType::int32, 2).size() / 2;
  }

  Eigen::Index nodes() const {
    return static_cast<Eigen::Index>(file.numbers<double>(dataset::kNodes, ElementType::float64, 2).size() /
                                     2);
  }

  Bytes packed_field(std::size_t row) {
    check_row(row);
    const std::scoped_lock lock(mutex);
    const Eigen::Index node_count = nodes();
    if (!fields)
      fields = file.open_chunked(dataset::kField, table.rows, static_cast<std::uint64_t>(node_count));
    return file.chunk(*fields, row, most_packed_bytes(node_count));
  }
};

Database::Database(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Database::~Database() = default;
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;

Database Database::open(const std::filesystem::path& path) {
  Hdf5File file(path);
  check_version(file);
  std::string digest = file.text_attribute(attribute::kDigest);
  std::string bridge_name = file.text_attribute(attribute::kBridgeName);
  std::vector<StoredPoint> points = read_control_points(file);
  SceneTable table = read_table(file, points.size());
  const std::size_t blocks =
      file.numbers<std::int32_t>(dataset::kBlockIndex, ElementType::int32, 2).size() / 2;
  check_points(file, points, blocks);
  check_scenes(file, table, blocks);
  return Database(std::unique_ptr<Implementation>(new Implementation{
      std::move(file), std::move(digest), std::move(bridge_name), std::move(points), table}));
}

const std::filesystem::path& Database::path() const {
  return implementation_->file.path();
}
const std::string& Database::digest() const {
  return implementation_->digest;
}
const std::string& Database::bridge_name() const {
  return implementation_->bridge_name;
}
const SceneTable& Database::table() const {
  return implementation_->table;
}
const std::vector<StoredPoint>& Database::control_points() const {
  return implementation_->points;
}

const SearchIndex& Database::search_index() const {
  const std::scoped_lock lock(implementation_->mutex);
  const SceneTable& table = implementation_->table;
  if (!implementation_->search_index)
    implementation_->search_index = read_search_index(implementation_->file, table.rows, table.points);
  return *implementation_->search_index;
}

const BlockLayout& Database::layout() const {
  const std::scoped_lock lock(implementation_->mutex);
  if (!implementation_->layout) implementation_->layout = read_layout(implementation_->file);
  return *implementation_->layout;
}

const Mesh& Database::mesh() const {
  const std::size_t blocks = layout().size();
  const std::scoped_lock lock(implementation_->mutex);
  if (!implementation_->mesh) implementation_->mesh = read_mesh(implementation_->file, blocks);
  return *implementation_->mesh;
}

std::string Database::bridge_text() const {
  return implementation_->file.text(dataset::kBridgeText);
}

bool Database::has_fields() const {
  return implementation_->scene_columns().has_fields;
}

Field Database::field(std::size_t row) const {
  if (!has_fields())
    throw Failure(fmt::format("{}: holds no fields; build it again without --fields none", path().string()));
  const auto field = unpack_field(implementation_->packed_field(row), implementation_->nodes());
  implementation_->file.require(field.has_value(), fmt::format("the field of scene {} is damaged",
                                                               to_string(table().scene(row), layout())));
  return *field;
}

Solution Database::solution(std::size_t row) const {
  return solution_of(record(row), field(row));
}

std::optional<std::size_t> Database::find(const Scene& scene) const {
  std::size_t low = 0;
  std::size_t high = table().rows;
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (precedes(table().scene(middle), scene))
      low = middle + 1;
    else
      high = middle;
  }
  return low < table().rows && table().scene(low) == scene ? std::optional(low) : std::nullopt;
}

Provenance Database::provenance() const {
  const Hdf5File& file = implementation_->file;
  return {bridge_name(),
          bridge_text(),
          file.text(dataset::kSolverSettings),
          file.text_attribute(attribute::kProgramVersion),
          file.text_attribute(attribute::kCompiler),
          file.text_attribute(attribute::kCompileFlags),
          file.text_attribute(attribute::kSolverRevision),
          file.text_attribute(attribute::kResultsKey)};
}

Record Database::record(std::size_t row) const {
  implementation_->check_row(row);
  const SceneColumns& columns = implementation_->scene_columns();
  const auto vertical = table().row(row);
  Record record;
  record.scene = table().scene(row);
  record.outcome = static_cast<Outcome>(table().outcome[row]);
  record.residual = columns.residual[row];
  record.iterations = columns.iterations[row];
  record.extent = static_cast<CollapseExtent>(table().collapse[row]);
  record.moving = moving_blocks(implementation_->file, columns.moving, table().rows, row);
  record.vertical.assign(vertical.begin(), vertical.end());
  if (columns.has_fields) record.packed_field = implementation_->packed_field(row);
  const auto checksum = columns.checksum.subspan(row * sizeof(Sha256), sizeof(Sha256));
  std::copy(checksum.begin(), checksum.end(), record.checksum.begin());
  return record;
}

double Database::residual(std::size_t row) const {
  implementation_->check_row(row);
  return implementation_->scene_columns().residual[row];
}

std::uint32_t Database::chunk_crc(std::size_t row) const {
  implementation_->check_row(row);
  const auto stored = implementation_->scene_columns().chunk_crc;
  implementation_->file.require(!stored.empty(), "holds no fields");
  return stored[row];
}

std::int32_t Database::variant(std::size_t row) const {
  implementation_->check_row(row);
  return implementation_->scene_columns().variant[row];
}

ByteView Database::dataset_bytes(const char* path) const {
  return implementation_->file.view(path).bytes;
}

}  // namespace voussoir
