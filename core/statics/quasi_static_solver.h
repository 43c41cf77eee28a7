#pragma once
/// @file Equilibrium of a scene by Newton's method.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/law/joint_quadrature.h"
#include "core/statics/skips.h"
#include "core/statics/solution.h"
#include "core/structure/model.h"
#include "core/structure/stage.h"

namespace voussoir {

struct EquilibriumSystem;

struct QuasiStaticSettings {
  double tolerance = 1e-8;       ///< largest unbalanced nodal force over the largest nodal load [-]
  double step_tolerance = 1e-5;  ///< the same at the end of a stage's steps before the last: what they leave
                                 ///< unbalanced is let go in the next
  double round_off =
      1e-12;  ///< a step this small against the largest displacement is round-off: converged, if
  double loose_tolerance = 1e-5;  ///< the residual is at most this (fine meshes cannot reach `tolerance`)
  /// Factorisations from a given start before the search goes on otherwise. Chosen, not tuned: pairs that
  /// stand take 4.7 linear systems from theirs (docs/numerics.md).
  int most_warm_iterations = 12;
  /// Factorisations of a search from rest. Of 209 singles of stiff bridges a plain limit of 30 leaves 7, of
  /// 20 leaves 16 (docs/speed.md).
  int most_iterations = 30;
  /// Factorisations with bolder steps where no fall is followed. 24 find two more of 113 scenes for twice the
  /// time (docs/speed.md).
  int most_bold_iterations = 12;
  int most_falling_iterations = 40;  ///< factorisations of a fall. Chosen, not tuned
  /// Factorisations of a patient search. Ten scenes of seven random bridges take 121 systems at most
  /// (docs/speed.md); chosen, not tuned.
  int most_patient_iterations = 100;
  /// The same where joints have slipped beforehand: equilibria are near. Chosen, not tuned.
  int most_slipped_iterations = 20;
  bool patient_first = false;  ///< true: searches descend, as a patient one does, before they go on boldly
  bool descends_near = true;   ///< true: a later stage's search that fails from its start first goes on from
                               ///< there as one that descends
  bool follow_falls = true;    ///< false: a search without progress goes on for a few bolder steps and
                               ///< then ends where it was, `unresolved`
  double collapse_displacement =
      0.1;  ///< [m] beyond it, and beyond ten sags of the bonded scene, blocks are falling
  JointRule joint_rule = JointRule::exact;
  Skips skips;
};

/// What other scenes let expect of one, by which CombinedSolver chooses what it tries, and in which order.
struct SceneHints {
  bool falls_likely = false;  ///< so that a motion is followed before an equilibrium is searched for
  bool falls_by_one = false;  ///< alone, exactly one of the missing blocks lets something fall, so that early
                              ///< on what they change adds up
  bool open_likely = false;   ///< fewer missing blocks have no answer whatever is tried, so that no patient
                              ///< search and no long motion is worth its time
};

/// A stage and where to look for its equilibrium. What is pointed to must outlive the call.
struct StageTask {
  Stage stage;
  const Field* start = nullptr;   ///< 2 x nodes, near the answer, NaN counts as zero; null: from rest
  const State* before = nullptr;  ///< where the stage before ended; null: nothing has slipped
  const Eigen::Matrix2Xd* slipped = nullptr;  ///< as in Solution, of a stage with nothing before it; null:
                                              ///< nothing has slipped
  const Parameters* parameters = nullptr;     ///< of the variant; null: those of the solver's model
  /// Implicit steps. Forces that would hold the stage where the one before ended (what lost blocks carried, a
  /// new load turned round) are let go in so many equal parts, and the joints' memory is updated after each.
  int steps = 1;
  bool patient_phase = false;  ///< the search begins with its patient phase, whatever the settings say
  bool starts_near = false;    ///< the start is so near the answer that a factorisation serves several steps
                               ///< even of a stage with nothing before it
  bool may_jump = true;        ///< false: a later stage without an equilibrium near is `unresolved` there
  bool keeps_steps = false;    ///< true: the solution has the states at the ends of all steps
  SceneHints hints{};          ///< of its scene

  bool has_slipped() const { return slipped != nullptr && slipped->size() > 0; }
};

/// Solves stages of one bridge, one solution a task in their order; used by one thread at a time. A solution
/// depends on its task only, not on the others.
using StageSolver = std::function<std::vector<Solution>(std::span<const StageTask>)>;

/// Solves stages of the variants of one structure, several side by side in SIMD lanes. Not thread-safe: one
/// solver a thread. A solution depends on its task only, to the last bit: not on the other lanes, nor on
/// earlier calls. The model must outlive the solver.
class QuasiStaticSolver {
 public:
  explicit QuasiStaticSolver(const Model& model, QuasiStaticSettings settings = {});
  ~QuasiStaticSolver();
  QuasiStaticSolver(QuasiStaticSolver&&) noexcept;
  QuasiStaticSolver& operator=(QuasiStaticSolver&&) noexcept;

  /// Equilibria at the stages' ends, with the scenes' blocks absent; one solution a task, in their order. A
  /// lane that finishes early takes the next task.
  ///
  /// Of a stage with nothing before it, a search from a given start that fails begins again from rest. One
  /// without progress goes on as a fall with bolder steps: `collapsed`, with the field at the moment when a
  /// displacement passes the limit. If nothing falls either, a patient search from rest has the last word:
  /// `standing` or `unresolved`. A later stage is followed from where the one before ended, with its jumps
  /// (stage_steps.h): `collapsed` when a block has moved away, with the field there. `start` is for the first
  /// step.
  std::vector<Solution> solve(std::span<const StageTask> tasks);

  Solution solve(const StageTask& task);

  /// One scene under its weight, from rest or from a start.
  Solution solve(const Scene& scene);
  Solution solve(const Scene& scene, const Field& start);

  const EquilibriumSystem& system() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace voussoir
