#pragma once
/// @file The evidence of the scenes that can matter: estimates from one noise level say in which order scenes
/// are worked out, until what is left holds next to nothing. Where the level is stated they are bounds.

#include <span>
#include <vector>

#include "database/records/scene_table.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// log_evidence_of_each, where no closed form over levels stands, without log_chance_of_silence, but
/// -infinity for rows that hold less than a share `left_out` of the probability together; the `count`
/// likeliest are never left out, and no sum of probabilities is off by more than that share. `beforehand` is
/// the log prior of each of the rows, `likely` are a few rows of which some explain the readings about as
/// well as any.
std::vector<double> evidence_that_matters(const Observation& observation, const SceneTable& table,
                                          std::span<const std::size_t> rows,
                                          std::span<const double> beforehand,
                                          std::span<const std::size_t> likely, std::size_t count,
                                          double left_out);

}  // namespace voussoir
