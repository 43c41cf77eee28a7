#pragma once
/// @file The solver that builds databases: Newton for scenes that stand, motion for all others.

#include <span>
#include <vector>

#include "core/motion/dynamic_solver.h"
#include "core/statics/quasi_static_solver.h"

namespace voussoir {

/// Solves scenes of one bridge, several side by side. Most scenes stand and Newton finds their equilibrium in
/// milliseconds. Where Newton sees no hope, the scene is set in motion under growing gravity. What falls is
/// `collapsed`, with the field at the dynamic settings' moment. What seems to come to rest is handed back to
/// Newton, which polishes the resting field to equilibrium; if there is none near, a block creeps, held by
/// nearly enough friction, and the motion is followed until it has come to rest or moved away.
///
/// A solution depends on its scene and start only, to the last bit. Not thread-safe: one solver a thread. The
/// bridge must outlive the solver. `residual` is a nodal one for standing scenes and that of DynamicSolution
/// otherwise; `iterations` counts linear systems, or time steps of a collapse.
class CombinedSolver {
 public:
  explicit CombinedSolver(const Bridge& bridge, const QuasiStaticSettings& newton = {},
                          const DynamicSettings& motion = {});

  std::vector<Solution> solve(std::span<const SceneStart> scenes);

 private:
  void follow(DynamicSolver& motion, std::span<const SceneStart> scenes, std::vector<Solution>& solutions);

  QuasiStaticSolver newton_;
  DynamicSolver motion_;
  DynamicSolver patient_motion_;
};

/// The same motion followed until friction that nearly holds has let go, or the bridge is really at rest.
DynamicSettings patient(DynamicSettings settings);

}  // namespace voussoir
