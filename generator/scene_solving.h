#pragma once
/// @file The solvers as the generator sees them, and the one way in which a scene is solved for the database.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/solve/settings.h"

namespace voussoir {

/// Solves scenes of one bridge, one solution a scene in their order; used by one thread at a time. A solution
/// depends on its scene and start only, not on the others.
using SceneSolver = std::function<std::vector<Solution>(std::span<const StageTask>)>;

struct SolverChoice {
  /// "key = value" lines: everything that the solver's answers for this model depend on.
  std::function<std::string(const Model&)> settings;
  std::function<SceneSolver(const Model&)> make_solver;  ///< called once for each thread
};

/// The program's own solvers (core/solve).
SolverChoice solver_with(const SolverSettings& settings);
SolverChoice quasi_static(const DynamicSettings& motion = {});
SolverChoice dynamic(const DynamicSettings& motion = {});

/// Solves the scenes and rounds their fields to the storage precision.
std::vector<Solution> solve_for_storage(const SceneSolver& solver, std::span<const StageTask> scenes);

/// The mirror image of a solution, in the same storage precision.
Solution mirrored_solution(const Solution& solution, const MirrorSymmetry& symmetry);

}  // namespace voussoir
