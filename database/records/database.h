#pragma once
/// @file Reading a database file. Opening is cheap: scene records and control displacements are mapped into
/// memory and everything else is read when it is asked for.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statics/solution.h"
#include "core/structure/block_layout.h"
#include "core/structure/mesh.h"
#include "core/structure/scene.h"
#include "database/records/provenance.h"
#include "database/records/record.h"
#include "database/search/search_index.h"

namespace voussoir {

/// A control point as the database knows it.
struct StoredPoint {
  std::string name;
  Point position;  ///< [m] in the reference configuration
  BlockId block;   ///< the block it belongs to; without that block the point has no displacement
};

/// One row for each scene, rows in the order of all_scenes (few removed blocks first, then lexicographic):
/// what a search over the whole database needs, as views into the database's memory. Views live as long as
/// the Database they come from.
struct SceneTable {
  std::size_t rows = 0;                   ///< scenes
  std::size_t points = 0;                 ///< control points
  std::size_t most_missing = 0;           ///< columns of `removed`
  std::span<const double> vertical;       ///< rows x points [m], up is positive, NaN where the block is gone
  std::span<const std::int32_t> removed;  ///< rows x most_missing, block ids in ascending order, then -1
  std::span<const std::uint8_t> outcome;  ///< values of Outcome
  std::span<const std::uint8_t> collapse{};  ///< values of CollapseExtent

  std::span<const double> row(std::size_t scene) const { return vertical.subspan(scene * points, points); }
  Scene scene(std::size_t row) const;
};

/// What is read on first use is safe to ask for from several threads.
class Database {
 public:
  /// Throws Failure if the file is missing or cannot be read, InputError if it is no (whole) database of a
  /// schema version that this program reads; the message names the file and what was expected.
  static Database open(const std::filesystem::path& path);
  ~Database();
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;

  const std::filesystem::path& path() const;
  const std::string& digest() const;  ///< SHA-256 of the content, hexadecimal
  const std::string& bridge_name() const;
  const SceneTable& table() const;
  const std::vector<StoredPoint>& control_points() const;

  const SearchIndex& search_index() const;  ///< of the table's rows; read on first use

  const BlockLayout& layout() const;  ///< read on first use
  const Mesh& mesh() const;           ///< read on first use
  std::string bridge_text() const;    ///< the bridge file as it was given to build-database
  bool has_fields() const;
  Field field(std::size_t row) const;  ///< displacement of all nodes [m]; throws Failure without fields
  Solution solution(std::size_t row) const;

  std::optional<std::size_t> find(const Scene& scene) const;  ///< row of a scene, or nothing

  Provenance provenance() const;
  Record record(std::size_t row) const;            ///< as it stands in the file, its checksum not verified
  double residual(std::size_t row) const;          ///< as in Solution
  std::uint32_t chunk_crc(std::size_t row) const;  ///< stored CRC-32 of the record's packed field
  std::int32_t variant(std::size_t row) const;     ///< kOnlyVariant in every file of this schema
  ByteView dataset_bytes(const char* path) const;  ///< a contiguous dataset (database/schema.h) as it stands

 private:
  struct Implementation;
  explicit Database(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace voussoir
