#pragma once
/// @file Which rows can matter under Gaussian errors of a stated level: clusters of the search index by their
/// boxes, then row by row against the largest variances that the box allows.

#include <vector>

#include "database/records/scene_table.h"
#include "database/search/search_index.h"
#include "lookup/evidence/box_variances.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// What is believed beforehand.
struct RowPriors {
  std::vector<double> row;      ///< log prior of each row of the table; -infinity for those that do not count
  std::vector<double> cluster;  ///< the largest of each cluster's rows
};

/// True if the errors are Gaussian, their level is stated, and neither a factor nor levellings are unknown.
bool gaussian_screen_applies(const Observation& observation);

class GaussianScreen {
 public:
  /// What table and index (with clusters) look into outlives the screen.
  GaussianScreen(const SceneTable& table, const SearchIndex& index) : table_(table), index_(index) {}

  /// Rows whose log prior and log evidence together reach `least` are among these, cluster by cluster.
  /// Precondition: gaussian_screen_applies.
  std::vector<std::size_t> rows_in_reach(const Observation& observation, const RowPriors& priors,
                                         double least) const;

 private:
  SceneTable table_;
  SearchIndex index_;
  mutable KeptBoxVariances kept_;
};

}  // namespace voussoir
