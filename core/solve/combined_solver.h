#pragma once
/// @file The solver that builds databases: Newton for scenes that stand, motion for all others.

#include <span>
#include <vector>

#include "core/solve/settings.h"

namespace voussoir {

/// Solves scenes of one variant, several side by side. Most scenes stand and Newton finds their equilibrium
/// in milliseconds; where joints are stiff against blocks, or along against across, by a search that
/// descends, for the intact bridge with all patience. Where Newton makes no progress, the scene is set in
/// motion under growing gravity. What falls is `collapsed`, with the field at the dynamic settings' moment.
/// What seems to come to rest is handed back to Newton, which polishes the resting field to equilibrium: to
/// one in which nothing has slipped beforehand if there is one near, otherwise to one with what the joints
/// have slipped in motion (Solution::slipped). If there is none either, Newton searches from rest with all
/// patience; and if that finds none, a block creeps, held by nearly enough friction, and the motion is
/// followed until it has come to rest or moved away. The intact bridge, from which all others start, shall
/// rest where it stands (settling.h). A pair apart that falls by one of its blocks (StageTask)
/// begins to move where its singles' motions add up to. Scenes that are said to fall are set in motion first;
/// those that are said to have no answer get no patience. Where no fields of falls are wanted, a scene
/// is set in motion near its missing blocks before all of it is (near_falls.h).
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
  std::vector<Solution> search(std::span<const StageTask> tasks);
  void look_nearby(std::span<const StageTask> tasks, std::vector<Solution>& solutions) const;
  enum class Whom { intact, all };
  void insist(std::span<const StageTask> tasks, Whom whom, std::vector<Solution>& solutions);
  bool falls_late(const StageTask& task, const DecisionRules& rules) const;
  std::vector<DynamicSolution> move(std::span<const StageTask> tasks, const DecisionRules& rules,
                                    bool patiently);
  std::vector<Solution> polish(std::vector<StageTask> tasks, std::span<const Solution> resting);
  void follow(const DecisionRules& rules, std::span<const StageTask> tasks, bool patiently,
              std::vector<Solution>& solutions);

  SolverSettings settings_;
  QuasiStaticSolver newton_;
  DynamicSolver motion_;
};

}  // namespace voussoir
