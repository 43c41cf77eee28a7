#pragma once
/// @file Equilibrium of a scene by Newton's method.

#include <memory>

#include "core/bridge.h"
#include "core/solution.h"

namespace voussoir {

struct QuasiStaticSettings {
  double tolerance = 1e-8;  ///< largest unbalanced nodal force over the largest nodal weight [-]
  double round_off =
      1e-12;  ///< a step this small against the largest displacement is round-off: converged, if
  double loose_tolerance = 1e-5;  ///< the residual is at most this (fine meshes cannot reach `tolerance`)
  int most_warm_iterations =
      12;                    ///< factorisations from a given start before the search starts again from zero
  int most_iterations = 30;  ///< factorisations from zero before the bridge is let fall
  int most_falling_iterations = 40;    ///< factorisations of the fall before the scene is `unresolved`
  double collapse_displacement = 0.1;  ///< [m] a standing bridge moves less; beyond it blocks are falling
};

/// Solves scenes of one bridge one after the other; keeps the symbolic factorisation and all work arrays.
/// Not thread-safe: one solver a thread. The result depends on the scene and the start only, not on earlier
/// calls. The bridge must outlive the solver. The constructor throws Failure if the bridge's stiffness is
/// singular.
class QuasiStaticSolver {
 public:
  explicit QuasiStaticSolver(const Bridge& bridge, QuasiStaticSettings settings = {});
  ~QuasiStaticSolver();
  QuasiStaticSolver(QuasiStaticSolver&&) noexcept;
  QuasiStaticSolver& operator=(QuasiStaticSolver&&) noexcept;

  /// Equilibrium under full gravity with the scene's blocks absent, from zero displacement. A search that
  /// fails goes on as a fall: `collapsed` with the field at the moment when a displacement passes the limit,
  /// or `unresolved`.
  Solution solve(const Scene& scene);

  /// The same from a start field near the answer (2 x nodes; NaN entries count as zero); should the search
  /// fail from there, it starts again from zero.
  Solution solve(const Scene& scene, const Field& start);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace voussoir
