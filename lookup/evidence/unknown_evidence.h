#pragma once
/// @file The evidence of scenes of a bridge that is not exactly known.

#include <array>
#include <vector>

#include "lookup/evidence/scatter_density.h"
#include "lookup/evidence/unknown_bridge.h"

namespace voussoir {

using ScatterLogs = std::array<double, kScatterFactors.size()>;

/// log p(readings | scene, kappa) for each of kScatterFactors of these rows of a table; -infinity for
/// impossible scenes. Silent sensors are left out. Works on so many threads; their number changes no result.
std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, const Observation& observation,
                                      const SceneTable& table, std::span<const std::size_t> rows,
                                      int threads);

}  // namespace voussoir
