#pragma once
/// @file Nearest neighbours of the readings among the scenes, by FLANN; candidates are rescored with the one
/// misfit.

#include <memory>
#include <span>
#include <vector>

#include "database/records/database.h"
#include "lookup/search/scored_row.h"

namespace voussoir {

enum class NearestMode {
  exact,       ///< linear search: the same answer as the exhaustive search
  approximate  ///< the database's trees: may miss a scene
};

struct NearestSettings {
  NearestMode mode = NearestMode::exact;
  int checks = 4096;  ///< of approximate mode: rows looked at
};

/// The `count` rows (of those given, in ascending order) with the smallest misfit among the neighbours that
/// FLANN finds, best first. Throws InputError if the trees (see NearestTrees) are damaged.
std::vector<ScoredRow> nearest_search(std::span<const double> readings, const SceneTable& table,
                                      std::span<const std::size_t> rows, ByteView trees,
                                      const NearestSettings& settings, std::size_t count);

/// FLANN's linear search over the displacements of some rows at the points that have readings.
class LinearIndex {
 public:
  /// Rows that lack a prediction for a reading are impossible and stay out of the index.
  LinearIndex(const SceneTable& table, std::span<const std::size_t> rows, std::span<const double> readings);
  ~LinearIndex();
  LinearIndex(LinearIndex&&) noexcept;
  LinearIndex& operator=(LinearIndex&&) noexcept;

  /// The `count` rows nearest in the L1 norm, best first. Readings at the same points as those of the
  /// constructor.
  std::vector<ScoredRow> search(std::span<const double> readings, std::size_t count) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace voussoir
