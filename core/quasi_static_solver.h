#pragma once
/// @file Equilibrium of a scene by Newton's method.

#include <memory>

#include "core/bridge.h"
#include "core/solution.h"

namespace voussoir {

struct QuasiStaticSettings {
  double tolerance = 1e-10;      ///< largest unbalanced nodal force over the largest nodal weight [-]
  int most_iterations = 25;      ///< of plain Newton before the fallback takes over
  int most_fallback_iterations = 200;  ///< of pseudo-transient continuation before the scene is `unresolved`
  double collapse_displacement = 0.1;  ///< [m] a standing bridge moves less; beyond it blocks are falling
};

/// Solves scenes of one bridge one after the other; keeps the symbolic factorisation and all work arrays.
/// Not thread-safe: one solver a thread. The result depends on the scene and the start only, not on earlier calls.
class QuasiStaticSolver {
 public:
  explicit QuasiStaticSolver(const Bridge& bridge, QuasiStaticSettings settings = {});
  ~QuasiStaticSolver();
  QuasiStaticSolver(QuasiStaticSolver&&) noexcept;
  QuasiStaticSolver& operator=(QuasiStaticSolver&&) noexcept;

  /// Equilibrium under full gravity with the scene's blocks absent, from zero displacement.
  Solution solve(const Scene& scene);

  /// The same from a start field (2 x nodes; NaN entries count as zero).
  Solution solve(const Scene& scene, const Field& start);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace voussoir
