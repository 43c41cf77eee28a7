#pragma once
/// @file The solvers as the generator sees them, and the one way in which a scene is solved for the database.

#include <functional>
#include <optional>
#include <string>

#include "core/bridge.h"
#include "core/quasi_static_solver.h"
#include "core/solution.h"

namespace voussoir {

/// Solves scenes of one bridge, from a start field or from zero; used by one thread at a time.
using SceneSolver = std::function<Solution(const Scene&, const std::optional<Field>& start)>;

struct SolverChoice {
  std::string settings;  ///< "key = value" lines: everything that the solver's answers depend on
  std::function<SceneSolver(const Bridge&)> make_solver;  ///< called once for each thread
};

SolverChoice quasi_static(const QuasiStaticSettings& settings = {});

/// Solves the scene and rounds its field to the storage precision.
Solution solve_for_storage(const SceneSolver& solver, const Scene& scene, const std::optional<Field>& start);

/// The mirror image of a solution, in the same storage precision.
Solution mirrored_solution(const Solution& solution, const MirrorSymmetry& symmetry);

}  // namespace voussoir
