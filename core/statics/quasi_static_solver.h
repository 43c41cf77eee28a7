#pragma once
/// @file Equilibrium of a scene by Newton's method.

#include <memory>
#include <span>
#include <vector>

#include "core/law/joint_law.h"
#include "core/statics/skips.h"
#include "core/statics/solution.h"
#include "core/structure/bridge.h"

namespace voussoir {

struct QuasiStaticSettings {
  double tolerance = 1e-8;  ///< largest unbalanced nodal force over the largest nodal load [-]
  double round_off =
      1e-12;  ///< a step this small against the largest displacement is round-off: converged, if
  double loose_tolerance = 1e-5;  ///< the residual is at most this (fine meshes cannot reach `tolerance`)
  int most_warm_iterations =
      12;                    ///< factorisations from a given start before the search starts again from zero
  int most_iterations = 30;  ///< factorisations of a search from zero
  int most_falling_iterations = 40;  ///< factorisations of a fall
  bool follow_falls = true;          ///< false: a search without hope ends there, `unresolved`
  double collapse_displacement =
      0.1;  ///< [m] beyond it, and beyond ten sags of the bonded scene, blocks are falling
  JointRule joint_rule = JointRule::exact;
  Skips skips;
};

/// A scene and where to look for its equilibrium.
struct SceneStart {
  Scene scene;
  const Field* start = nullptr;  ///< 2 x nodes, near the answer, NaN counts as zero; null: from rest
};

/// Solves scenes of one bridge, several side by side in SIMD lanes. Not thread-safe: one solver a thread. A
/// solution depends on its scene and start only, to the last bit: not on the other lanes, nor on earlier
/// calls. The bridge must outlive the solver.
class QuasiStaticSolver {
 public:
  /// `dead_load`: forces on the nodes beside the weight [N], 2 x nodes; empty for none.
  explicit QuasiStaticSolver(const Bridge& bridge, QuasiStaticSettings settings = {},
                             const Field& dead_load = {});
  ~QuasiStaticSolver();
  QuasiStaticSolver(QuasiStaticSolver&&) noexcept;
  QuasiStaticSolver& operator=(QuasiStaticSolver&&) noexcept;

  /// Equilibria under full gravity with the scenes' blocks absent; one solution a scene, in their order. A
  /// lane that finishes early takes the next scene.
  ///
  /// A search from a given start that fails begins again from rest. One without hope goes on as a fall with
  /// bolder steps: `collapsed`, with the field at the moment when a displacement passes the limit. If nothing
  /// falls either, a patient search from rest has the last word: `standing` or `unresolved`.
  std::vector<Solution> solve(std::span<const SceneStart> scenes);

  /// One scene, from rest.
  Solution solve(const Scene& scene);

  /// One scene, from a start.
  Solution solve(const Scene& scene, const Field& start);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace voussoir
