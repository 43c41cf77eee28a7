#pragma once
/// @file Reading a database file. Opening is cheap: scene records and control displacements are mapped into
/// memory and everything else is read when it is asked for.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/structure/block_layout.h"
#include "core/structure/joint.h"
#include "core/structure/mesh.h"
#include "database/records/model_error.h"
#include "database/records/provenance.h"
#include "database/records/record.h"
#include "database/records/scene_table.h"
#include "database/records/sensitivities.h"
#include "database/records/shard.h"
#include "database/records/variant_parameters.h"
#include "database/search/search_index.h"

namespace voussoir {

/// A control point, or a sensor of the bridge file, as the database knows it.
struct StoredPoint {
  std::string name;
  Point position;  ///< [m] in the reference configuration; of a distance the middle
  BlockId block;   ///< the block it belongs to; without that block the point shows nothing
  Quantity quantity = Quantity::uy;
  std::optional<BlockId> other_block{};  ///< of a distance between two blocks the second: the same holds
  bool is_on(BlockId id) const { return id == block || id == other_block; }
};

/// The records of a bridge: a row for each scene of each variant, in row_order, each with the same states.
/// Variants and states are numbered from 0: the nominal bridge, and what states() names first. What is read
/// on first use is safe to ask for from several threads.
class Database {
 public:
  /// Throws Failure if the file is missing or cannot be read, InputError if it is no (whole) database of the
  /// schema version that this program reads; the message names the file, what was expected and, for another
  /// version, what to do.
  static Database open(const std::filesystem::path& path);
  ~Database();
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;

  const std::filesystem::path& path() const;
  const std::string& digest() const;  ///< SHA-256 of the content, hexadecimal
  const std::string& bridge_name() const;
  const std::vector<StoredPoint>& control_points() const;  ///< and the sensors of the bridge file
  /// What each of them reads; none: how far its node goes up.
  std::vector<std::vector<NodeWeight>> point_weights() const;
  const std::vector<std::string>& states() const;          ///< names, at least one
  const std::vector<ModelError>& model_errors() const;     ///< one for each state
  const std::vector<VariantParameters>& variants() const;  ///< read on first use
  const std::optional<ShardStatement>& shard() const;      ///< nothing: it is whole
  const Sensitivities* sensitivities() const;              ///< null if it holds none; read on first use
  std::optional<std::size_t> find_state(std::string_view name) const;  ///< its number, or nothing
  std::size_t variant_count() const;                                   ///< at least one

  const SceneTable& table() const;  ///< of the nominal variant in the first state
  /// Throws InputError for a variant or state that does not exist.
  SceneTable table(std::int32_t variant, std::size_t state) const;
  /// The nominal variant's table with what a bridge that is not exactly known may show beside: of uncertain
  /// falls what they would read if they stood (Sensitivities::find_fall). The table itself if there are none;
  /// made on first use. Throws as table.
  SceneTable table_if_standing(std::size_t state) const;
  /// Of the nominal variant in a history's own state, or in the first; read on first use. Throws InputError
  /// for other states, which have none.
  const SearchIndex& search_index(std::size_t state = 0) const;

  const BlockLayout& layout() const;         ///< read on first use
  const Mesh& mesh() const;                  ///< read on first use
  const std::vector<Joint>& joints() const;  ///< read on first use
  std::string bridge_sha256() const;         ///< of the bridge text, as the file states it
  std::string bridge_text() const;           ///< the bridge file as it was given to build-database
  Provenance provenance() const;

  std::size_t rows() const;  ///< records, of all variants
  RecordKey key(std::size_t row) const;
  std::optional<std::size_t> find(std::int32_t variant, const Scene& scene) const;  ///< row, or nothing
  std::optional<std::size_t> find(const Scene& scene) const;  ///< in the nominal variant
  Record record(std::size_t row) const;  ///< as it stands in the file, its checksum not verified
  bool has_fields() const;
  /// Displacement of all nodes [m]; throws Failure without fields.
  Field field(std::size_t row, std::size_t state = 0) const;
  Solution solution(std::size_t row, std::size_t state = 0) const;
  /// Does the intact bridge stand only by what its joints have slid (Solution::slipped)? Not said, and so
  /// false, without fields.
  bool stands_by_slip(std::size_t state = 0) const;
  ByteView dataset_bytes(
      const char* path) const;  ///< a contiguous dataset (database/records/schema.h) as it stands

 private:
  struct Implementation;
  explicit Database(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// Does the file state that it is a database, of whatever schema version, or begin as one that is damaged?
/// False for any other file, also of HDF5.
bool is_named_database(const std::filesystem::path& path);

}  // namespace voussoir
