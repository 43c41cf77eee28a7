#pragma once
/// @file From above, the evidence of the scenes of a cluster of the search index, from the cluster's box
/// alone.

#include <vector>

#include "database/search/search_index.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// True if there are bounds for these readings: the level is stated, or the evidence over all levels has a
/// closed form, and neither the common factor nor levellings are unknown.
bool cluster_bounds_apply(const Observation& observation);

/// For each cluster no less than the log evidence of any of its scenes, silent sensors left out; -infinity if
/// none is possible. Precondition: cluster_bounds_apply.
std::vector<double> cluster_bounds(const Observation& observation, const SearchIndex& index);

}  // namespace voussoir
