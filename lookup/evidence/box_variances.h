#pragma once
/// @file What bounds the densities of a box's rows and does not depend on what was read, only on where and
/// with which errors: the same for all readings of one set of sensors.

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "database/search/search_index.h"
#include "lookup/evidence/index_box.h"

namespace voussoir {

/// Of some clusters of a search index, one after the other.
struct BoxVariances {
  std::size_t first = 0;        ///< of the clusters
  std::vector<double> weight;   ///< [1/m2] for each place: one over the largest variance of a row there, 0
                                ///< where there is no reading
  std::vector<double> highest;  ///< that the logarithm of a density can be, but for squares and what all
                                ///< boxes share; in the arrays' unit
};

/// Of the clusters from `first` to before `last`.
BoxVariances box_variances(const PlaceArrays& arrays, const SearchIndex& index, std::size_t first,
                           std::size_t last);

/// Those of all clusters for the sensors that were asked about twice. Any number of threads may ask.
class KeptBoxVariances {
 public:
  /// Nothing if they are not kept (yet): sensors that are asked about once are not worth it.
  std::shared_ptr<const BoxVariances> find(const PlaceArrays& arrays, const SearchIndex& index);

 private:
  std::mutex mutex_;
  std::optional<PlaceArrays> asked_, kept_for_;
  std::shared_ptr<const BoxVariances> kept_;
};

}  // namespace voussoir
