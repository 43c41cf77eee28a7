#pragma once
/// @file Nearest neighbours of the readings among the scenes, by FLANN; candidates are rescored with the one
/// misfit. FLANN's index is made of the database's displacements when it is needed and never read from a
/// file: FLANN does not check the bytes of its own files.

#include <memory>
#include <span>
#include <vector>

#include "database/records/database.h"
#include "lookup/search/scored_row.h"

namespace voussoir {

/// FLANN's linear search, with the exhaustive search's answer, over the displacements of some rows at the
/// points that have readings.
class LinearIndex {
 public:
  /// Rows that lack a prediction for a reading are impossible and stay out of the index.
  LinearIndex(const SceneTable& table, std::span<const std::size_t> rows, std::span<const double> readings);
  ~LinearIndex();

  /// The `count` rows nearest in the L1 norm, best first. Readings at the same points as those of the
  /// constructor.
  std::vector<ScoredRow> search(std::span<const double> readings, std::size_t count) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace voussoir
