#pragma once
/// @file The evidence of scenes of a bridge that is not exactly known.

#include <array>
#include <vector>

#include "lookup/evidence/scatter_density.h"
#include "lookup/evidence/unknown_bridge.h"

namespace voussoir {

/// What a case makes of a bridge's noise, in the form that densities are made of.
struct CaseTerms {
  double conditions = 1.0;
  double spread = 0.0;
  LowerTriangle noise;
};
CaseTerms case_terms(const UnknownBridge& bridge);

/// log p(readings | scene, case, kappa) of these rows of a table, for each of kScatterFactors: row by row,
/// for each of the cases; -infinity for impossible scenes and where it is not `wanted` (the same order;
/// empty: all are). Silent sensors are left out. Works on so many threads; their number changes no result.
std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, std::span<const CaseTerms> cases,
                                      const Observation& observation, const SceneTable& table,
                                      std::span<const std::size_t> rows, std::span<const std::uint8_t> wanted,
                                      int threads);

/// The same in the bridge's own case.
std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, const Observation& observation,
                                      const SceneTable& table, std::span<const std::size_t> rows,
                                      int threads);

}  // namespace voussoir
