#pragma once
/// @file Equilibria of a bridge whose joints are far stiffer than its blocks, from those with softer joints.

#include <span>
#include <vector>

#include "core/statics/quasi_static_solver.h"

namespace voussoir {

/// How far a search came.
struct Approach {
  Solution solution;     ///< `standing`, or `unresolved` if there is no equilibrium on the way
  double reached = 0.0;  ///< share of the joints' stiffness with which there is one; 0: none was found
};

/// Which joints are closed, and which slide, Newton's method finds the harder the stiffer they are. So the
/// tasks' equilibria are searched with joints that have a share `softest` of their stiffness, then from there
/// with joints ten times as stiff, and so on up to their own. `parameters` are those of the solver's model.
/// Precondition: dry joints, tasks of one step.
std::vector<Approach> approach_from_softer_joints(QuasiStaticSolver& solver, const Parameters& parameters,
                                                  double softest, std::span<const StageTask> tasks);

/// Newton's settings for that: each equilibrium is near the next one, or there is none.
QuasiStaticSettings approaching(QuasiStaticSettings settings);

}  // namespace voussoir
