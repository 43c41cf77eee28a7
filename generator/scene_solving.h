#pragma once
/// @file The solvers as the generator sees them, and the one way in which a scene is solved for the database.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/bridge.h"
#include "core/quasi_static_solver.h"
#include "core/solution.h"
#include "generator/start_field.h"

namespace voussoir {

/// Solves scenes of one bridge, each from its start field or from zero; used by one thread at a time. A
/// solution does not depend on the scenes that are solved with it.
using SceneSolver = std::function<std::vector<Solution>(std::span<const SceneStart>)>;

struct SolverChoice {
  std::string settings;  ///< "key = value" lines: everything that the solver's answers depend on
  std::function<SceneSolver(const Bridge&)> make_solver;  ///< called once for each thread
};

SolverChoice quasi_static(const QuasiStaticSettings& settings = {});

/// Solves the scenes and rounds their fields to the storage precision.
std::vector<Solution> solve_for_storage(const SceneSolver& solver, std::span<const Scene> scenes,
                                        const StartingFields& starts);

/// The mirror image of a solution, in the same storage precision.
Solution mirrored_solution(const Solution& solution, const MirrorSymmetry& symmetry);

}  // namespace voussoir
