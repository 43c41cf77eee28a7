#pragma once
/// @file Solving scenes of a database anew.

#include "database/records/database.h"
#include "generator/build_plan.h"
#include "generator/scene_solving.h"

namespace voussoir {

/// `count` different rows of a table of `rows`, in ascending order; the same for the same seed everywhere.
std::vector<std::size_t> choose_rows(std::size_t rows, std::size_t count, std::uint64_t seed);

/// Solves the scene of a variant by the rule that build-database follows: its mirror image if that is the one
/// solved, from the stored fields of the variant's intact bridge and singles, or from those solved anew where
/// the database has none. `bridge` and `solver` are the variant's.
Solution recompute(const RecordKey& key, const Database& database, const Model& bridge,
                   const PlanRules& rules, const SceneSolver& solver);

/// Largest difference [m] between stored and recomputed displacements in the first state: of all nodes, or of
/// the control points if the database has no fields. Infinite if a displacement is there in only one of them.
double largest_difference(const Solution& recomputed, const Database& database, std::size_t row,
                          const std::vector<ControlPoint>& points);

}  // namespace voussoir
