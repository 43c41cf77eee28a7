#pragma once
/// @file Nearest neighbours of the readings among the scenes, by FLANN; candidates are rescored with the one
/// misfit.

#include <memory>
#include <span>
#include <vector>

#include "database/database.h"
#include "lookup/candidate.h"

namespace voussoir {

enum class NearestMode {
  exact,       ///< linear search: the same answer as the exhaustive search
  approximate  ///< randomised k-d trees: may miss a scene
};

struct NearestSettings {
  NearestMode mode = NearestMode::exact;
  int trees = 4;      ///< approximate mode only, here and below
  int checks = 4096;  ///< leaves visited
  std::size_t oversampling =
      20;  ///< neighbours fetched for each one wanted, because trees order them roughly
};

/// An index over the displacements of some rows at the points that have readings.
class NearestIndex {
 public:
  /// Rows that lack a prediction for a reading are impossible and stay out of the index.
  NearestIndex(const SceneTable& table, std::span<const std::size_t> rows, std::span<const double> readings,
               const NearestSettings& settings);
  ~NearestIndex();
  NearestIndex(NearestIndex&&) noexcept;
  NearestIndex& operator=(NearestIndex&&) noexcept;

  /// The `count` rows nearest in the L1 norm, best first. Readings at the same points as those of the
  /// constructor.
  std::vector<ScoredRow> search(std::span<const double> readings, std::size_t count) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace voussoir
