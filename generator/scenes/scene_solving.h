#pragma once
/// @file The one way in which a scene is solved for the database.

#include <span>
#include <vector>

#include "generator/scenes/solvers.h"

namespace voussoir {

/// Solves the scenes and rounds their fields, and what has slipped beforehand, to the storage precision. What
/// the joints remember at the end is left out where it follows from these: after one step or a jump.
std::vector<Solution> solve_for_storage(const StageSolver& solver, std::span<const StageTask> scenes);

/// The mirror image of a solution, in the same storage precision and without memory.
/// Precondition: the bridge is symmetric.
Solution mirrored_solution(const Solution& solution, const Structure& bridge);

}  // namespace voussoir
