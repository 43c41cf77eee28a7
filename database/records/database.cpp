#include "database/records/database.h"

#include <algorithm>
#include <mutex>

#include "database/format/hdf5_file.h"
#include "database/records/if_standing.h"
#include "database/records/schema.h"
#include "database/records/stored_geometry.h"
#include "database/records/stored_records.h"
#include "database/records/stored_sensitivities.h"
#include "database/records/stored_table.h"
#include "database/search/stored_index.h"

namespace voussoir {
namespace {

void check_version(const Hdf5File& file) {
  file.require(file.text_attribute(attribute::kFormat) == kFormatName,
               "this HDF5 file is no database (expected one written by build-database)");
  const int version = file.int_attribute(attribute::kSchemaVersion);
  file.require(version == kSchemaVersion,
               fmt::format("schema version {} where {} was expected: build the database again with this "
                           "program's build-database [BRIDGE.toml] -o {}",
                           version, kSchemaVersion, file.path().string()));
}

void check_points(const Hdf5File& file, const std::vector<StoredPoint>& points, std::size_t blocks) {
  const auto exists = [&](BlockId block) {
    return value(block) >= 0 && static_cast<std::size_t>(block) < blocks;
  };
  for (const StoredPoint& point : points)
    file.require(exists(point.block) && (!point.other_block || exists(*point.other_block)),
                 fmt::format("control point {} belongs to a block that does not exist", point.name));
}

std::size_t count_blocks(const Hdf5File& file) {
  return file.numbers<std::int32_t>(dataset::kBlockIndex, ElementType::int32, 2).size() / 2;
}

std::size_t count_nodes(const Hdf5File& file) {
  return file.numbers<double>(dataset::kNodes, ElementType::float64, 2).size() / 2;
}

std::size_t count_joints(const Hdf5File& file) {
  return file.has(dataset::kJointLength)
             ? file.numbers<double>(dataset::kJointLength, ElementType::float64, kFlat).size()
             : 0;
}

/// Something that is read when it is first asked for.
template <class T>
class OnFirstUse {
 public:
  template <class Read>
  const T& get(const Read& read) {
    const std::scoped_lock lock(mutex_);
    if (!value_) value_.emplace(read());
    return *value_;
  }

 private:
  std::mutex mutex_;
  std::optional<T> value_;
};

std::optional<ShardStatement> read_shard(const Hdf5File& file) {
  if (!file.has(dataset::kShard)) return std::nullopt;
  const auto statement = parse_shard_statement(file.text(dataset::kShard));
  file.require(statement.has_value(),
               fmt::format("dataset '{}' says nothing of a shard such as 3/16", dataset::kShard));
  return statement;
}

}  // namespace

struct Database::Implementation {
  Hdf5File file;
  std::optional<ShardStatement> shard = read_shard(file);
  std::string digest = file.text_attribute(attribute::kDigest);
  std::string bridge_name = file.text_attribute(attribute::kBridgeName);
  std::vector<StoredPoint> points = read_control_points(file);
  std::vector<std::string> states = read_states(file);
  std::vector<ModelError> model_errors = read_model_errors(file, states.size(), points.size());
  StoredTable rows{file, count_blocks(file), points.size(), states.size(), read_variant_count(file)};
  SceneTable table = rows.part(kNominalVariant, 0);

  std::vector<OnFirstUse<SearchIndex>> search_indices = std::vector<OnFirstUse<SearchIndex>>(states.size());
  OnFirstUse<BlockLayout> layout{};
  OnFirstUse<Mesh> mesh{};
  OnFirstUse<std::vector<Joint>> joints{};
  OnFirstUse<std::vector<VariantParameters>> variants{};
  OnFirstUse<StoredRecords> records{};
  OnFirstUse<std::optional<Sensitivities>> sensitivities{};
  std::vector<OnFirstUse<std::optional<IfStanding>>> if_standing =
      std::vector<OnFirstUse<std::optional<IfStanding>>>(states.size());

  void check_row(std::size_t row) const {
    if (row >= rows.sizes().records)
      file.refuse(fmt::format("no record {} (0 to {} exist)", row, rows.sizes().records - 1));
  }
  void check_state(std::size_t state) const {
    if (state >= states.size())
      file.refuse(fmt::format("no state {} (0 to {} exist)", state, states.size() - 1));
  }
  const StoredRecords& stored_records() {
    return records.get([&] {
      Sizes sizes = rows.sizes();
      sizes.nodes = count_nodes(file);
      sizes.joints = count_joints(file);
      return StoredRecords(file, sizes);
    });
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
  Database database(std::unique_ptr<Implementation>(new Implementation{std::move(file)}));
  const Implementation& opened = *database.implementation_;
  check_points(opened.file, opened.points, opened.rows.sizes().blocks);
  return database;
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
const std::vector<StoredPoint>& Database::control_points() const {
  return implementation_->points;
}
const std::vector<std::string>& Database::states() const {
  return implementation_->states;
}
const std::vector<ModelError>& Database::model_errors() const {
  return implementation_->model_errors;
}
std::optional<std::size_t> Database::find_state(std::string_view name) const {
  const auto found = std::ranges::find(states(), name);
  return found == states().end() ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(found - states().begin()));
}
std::size_t Database::variant_count() const {
  return implementation_->rows.variants();
}
const SceneTable& Database::table() const {
  return implementation_->table;
}
std::size_t Database::rows() const {
  return implementation_->rows.sizes().records;
}

SceneTable Database::table(std::int32_t variant, std::size_t state) const {
  const std::size_t count = variant_count();
  if (variant < 0 || static_cast<std::size_t>(variant) >= count)
    implementation_->file.refuse(fmt::format("no variant {} (0 to {} exist)", variant, count - 1));
  implementation_->check_state(state);
  return implementation_->rows.part(static_cast<std::size_t>(variant), state);
}

SceneTable Database::table_if_standing(std::size_t state) const {
  SceneTable result = table(kNominalVariant, state);
  const Sensitivities* const known = sensitivities();
  if (known == nullptr) return result;
  const auto& made = implementation_->if_standing[state].get(
      [&] { return if_standing(result, *known, state, control_points()); });
  if (!made) return result;
  result.vertical = made->vertical;
  result.standing_share = made->standing_share;
  return result;
}

const std::vector<VariantParameters>& Database::variants() const {
  const std::size_t joint_count = joints().size();
  return implementation_->variants.get(
      [&] { return read_parameters(implementation_->file, layout().size(), joint_count); });
}

const Sensitivities* Database::sensitivities() const {
  const Implementation& opened = *implementation_;
  const auto& found = implementation_->sensitivities.get([&] {
    return read_sensitivities(opened.file,
                              {opened.states.size(), opened.points.size(), opened.rows.sizes().blocks});
  });
  return found ? &*found : nullptr;
}

const SearchIndex& Database::search_index(std::size_t state) const {
  implementation_->check_state(state);
  return implementation_->search_indices[state].get([&] {
    const SceneTable rows = table(kNominalVariant, state);
    return read_search_index(implementation_->file, states()[state], rows.vertical, rows.points);
  });
}

const BlockLayout& Database::layout() const {
  return implementation_->layout.get([&] { return read_layout(implementation_->file); });
}

const Mesh& Database::mesh() const {
  return implementation_->mesh.get([&] { return read_mesh(implementation_->file, layout().size()); });
}

const std::vector<Joint>& Database::joints() const {
  return implementation_->joints.get([&] { return read_joints(implementation_->file, mesh()); });
}

std::vector<std::vector<NodeWeight>> Database::point_weights() const {
  return read_weights(implementation_->file, control_points(), mesh());
}

std::string Database::bridge_text() const {
  return implementation_->file.text(dataset::kBridgeText);
}

std::string Database::bridge_sha256() const {
  return implementation_->file.text_attribute(attribute::kBridgeSha256);
}

bool Database::has_fields() const {
  return implementation_->file.has(dataset::kField);
}

Field Database::field(std::size_t row, std::size_t state) const {
  implementation_->check_row(row);
  implementation_->check_state(state);
  if (!has_fields())
    throw Failure(fmt::format("{}: holds no fields; build it again without --fields none", path().string()));
  return implementation_->stored_records().field(row, state);
}

Solution Database::solution(std::size_t row, std::size_t state) const {
  Field displacement = field(row, state);
  return solution_of(record(row).states[state], std::move(displacement));
}

RecordKey Database::key(std::size_t row) const {
  implementation_->check_row(row);
  return implementation_->rows.key(row);
}

std::optional<std::size_t> Database::find(std::int32_t variant, const Scene& scene) const {
  return implementation_->rows.find(variant, scene);
}

std::optional<std::size_t> Database::find(const Scene& scene) const {
  return find(kNominalVariant, scene);
}

const std::optional<ShardStatement>& Database::shard() const {
  return implementation_->shard;
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
  return implementation_->stored_records().read(row);
}

ByteView Database::dataset_bytes(const char* path) const {
  return implementation_->file.view(path).bytes;
}

/// Records are opened only where some state has slid: that takes a program longer than its start.
bool Database::stands_by_slip(std::size_t state) const {
  implementation_->check_state(state);
  if (!implementation_->file.has(dataset::kSlipped)) return false;
  const auto intact = find(Scene{});
  return intact && !record(*intact).states[state].slipped.empty();
}

bool is_named_database(const std::filesystem::path& path) {
  constexpr std::size_t kBeginning = 4096;  // bytes in which the first dataset is described
  if (!begins_like_hdf5(path)) return false;
  try {
    return Hdf5File(path).text_attribute(attribute::kFormat) == kFormatName;
  } catch (const InputError&) {  // damaged, if it is one
    const MappedFile mapped(path);
    const ByteView beginning = mapped.bytes().first(std::min(kBeginning, mapped.bytes().size()));
    return !std::ranges::search(beginning, view_bytes(std::string_view(kBridgeTextMeaning))).empty();
  }
}

}  // namespace voussoir
