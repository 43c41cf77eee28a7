#pragma once
/// @file The solver that builds databases: Newton for scenes that stand, motion for all others.

#include <span>
#include <vector>

#include "core/solve/settings.h"

namespace voussoir {

/// Solves scenes of one variant, several side by side. Most scenes stand and Newton finds their equilibrium
/// in milliseconds; where joints are stiff against blocks, or along against across, by a search that
/// descends, for the intact bridge by the patient phase (SearchPhase). Where Newton makes no progress, the
/// scene is set in motion under growing gravity. What falls is `collapsed`, with the field at the dynamic
/// settings' moment. What seems to come to rest is handed back to Newton, which brings the resting field to
/// equilibrium: to one in which nothing has slipped beforehand if there is one near, otherwise to one with
/// what the joints have slipped in motion (Solution::slipped). If there is none either, Newton searches from
/// rest by the patient phase; and if that finds none, a block creeps, held by nearly enough friction, and the
/// motion is followed until it has come to rest or moved away. The intact bridge, from which all others
/// start, shall rest where it stands (settling.h). A pair apart that falls by one of its blocks (SceneHints)
/// begins to move where its singles' motions add up to. Scenes that are said to fall are set in motion first;
/// those that are said to have no answer get no patient search and no long motion. Where no fields of falls
/// are wanted, a scene is set in motion near its missing blocks before all of it is (near_falls.h).
///
/// A solution depends on its scene and start only, to the last bit. Not thread-safe: one solver a thread. The
/// model must outlive the solver. `residual` is a nodal one for standing scenes and that of DynamicSolution
/// otherwise; `iterations` counts linear systems, or time steps of a collapse.
class CombinedSolver {
 public:
  /// `settings` as acting_settings gives them.
  CombinedSolver(const Model& model, const SolverSettings& settings);
  explicit CombinedSolver(const Model& model)
      : CombinedSolver(model, acting_settings(SolverSettings::of(SolverKind::quasi_static), model)) {}

  /// Stages with nothing before them: whole scenes under their weight, of the model itself
  /// (StageTask::parameters is null: motions have one variant). Later stages are left to Newton.
  std::vector<Solution> solve(std::span<const StageTask> tasks);

 private:
  enum class Scenes { intact, all };
  enum class Followed {
    as_set,      ///< by the decision rules of the motion's settings
    to_the_end,  ///< by the patient rules, and from rest
  };
  // What has no answer yet may get one; all other solutions stay as they are.
  std::vector<Solution> search_from_starts(std::span<const StageTask> tasks);
  std::vector<Solution> search_from_rest(std::span<const StageTask> tasks, Scenes scenes,
                                         std::vector<Solution> solutions);
  std::vector<Solution> find_near_falls(std::span<const StageTask> tasks,
                                        std::vector<Solution> solutions) const;
  std::vector<Solution> follow_motions(std::span<const StageTask> tasks, Followed followed,
                                       std::vector<Solution> solutions);

  const DecisionRules& rules_of(Followed followed) const;
  bool falls_late(const StageTask& task, const DecisionRules& rules) const;
  std::vector<DynamicSolution> motions_of(std::span<const StageTask> tasks, Followed followed);
  StageTask task_at_rest(const StageTask& task, Followed followed, const Solution& resting) const;
  std::vector<Solution> equilibria_near(std::span<const Solution> resting, std::vector<StageTask> tasks);

  SolverSettings settings_;
  QuasiStaticSolver newton_;
  DynamicSolver motion_;
};

}  // namespace voussoir
