#pragma once
/// @file The solvers as the generator sees them, and the one way in which a scene is solved for the database.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/motion/dynamic_solver.h"
#include "core/statics/quasi_static_solver.h"
#include "core/statics/solution.h"
#include "core/structure/bridge.h"

namespace voussoir {

/// Solves scenes of one bridge, one solution a scene in their order; used by one thread at a time. A solution
/// depends on its scene and start only, not on the others.
using SceneSolver = std::function<std::vector<Solution>(std::span<const SceneStart>)>;

struct SolverChoice {
  std::string settings;  ///< "key = value" lines: everything that the solver's answers depend on
  std::function<SceneSolver(const Bridge&)> make_solver;  ///< called once for each thread
};

/// Newton for scenes that stand, motion for the others (core/solve/combined_solver.h).
/// Newton has the motion's skips.
SolverChoice quasi_static(const DynamicSettings& motion = {});

/// Motion for all scenes: the reference.
SolverChoice dynamic(const DynamicSettings& motion = {});

/// The solver whose settings a database states. Throws Failure if this program has none with just these.
SolverChoice solver_with(std::string_view settings);

/// Solves the scenes and rounds their fields to the storage precision.
std::vector<Solution> solve_for_storage(const SceneSolver& solver, std::span<const SceneStart> scenes);

/// The mirror image of a solution, in the same storage precision.
Solution mirrored_solution(const Solution& solution, const MirrorSymmetry& symmetry);

}  // namespace voussoir
