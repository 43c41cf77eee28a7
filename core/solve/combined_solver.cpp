#include "core/solve/combined_solver.h"

#include <cmath>

namespace voussoir {
namespace {

/// How stiff joints are against blocks, p_n b / E with a mean block's size b.
double joint_stiffness_ratio(const Bridge& bridge) {
  double size = 0.0;
  for (const Block& block : bridge.layout.blocks)
    size += std::sqrt(area(block.polygon)) / bridge.block_count();
  return bridge.description.joints.normal_stiffness * size / bridge.description.material.young_modulus;
}

/// Newton for scenes that stand. That three steps show whether there is hope was measured on joints that are
/// softer than blocks; stiffer ones take some ten steps.
QuasiStaticSettings without_falls(const Bridge& bridge, QuasiStaticSettings settings) {
  settings.follow_falls = false;
  if (joint_stiffness_ratio(bridge) > 1.0) settings.skips.early_outcome = false;
  return settings;
}

}  // namespace

DynamicSettings patient(DynamicSettings settings) {
  // Measured on the reference bridge: a bridge at rest goes below 1e-7 of its weight within a second; a block
  // that creeps keeps 4e-3 and more of its own weight unbalanced and takes up to four seconds to move away.
  settings.standing_unbalance = 1e-7;
  settings.collapsing_unbalance = 1e-3;
  settings.latest_decision = 8.0;
  return settings;
}

CombinedSolver::CombinedSolver(const Bridge& bridge, const QuasiStaticSettings& newton,
                               const DynamicSettings& motion)
    : newton_(bridge, without_falls(bridge, newton)),
      motion_(bridge, motion),
      patient_motion_(bridge, patient(motion)) {}

std::vector<Solution> CombinedSolver::solve(std::span<const SceneStart> scenes) {
  std::vector<Solution> solutions = newton_.solve(scenes);
  follow(motion_, scenes, solutions);
  follow(patient_motion_, scenes, solutions);
  return solutions;
}

/// Sets the scenes that are still open in motion: takes the collapses, polishes what rests.
void CombinedSolver::follow(DynamicSolver& motion, std::span<const SceneStart> scenes,
                            std::vector<Solution>& solutions) {
  std::vector<std::size_t> open;
  std::vector<Scene> moving;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (solutions[i].outcome == Outcome::unresolved) {
      open.push_back(i);
      moving.push_back(scenes[i].scene);
    }
  std::vector<DynamicSolution> motions = motion.solve(moving);

  std::vector<SceneStart> resting;
  std::vector<std::size_t> resting_at;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (motions[k].solution.outcome == Outcome::collapsed) {
      solutions[open[k]] = std::move(motions[k].solution);
    } else {
      resting.push_back({moving[k], &motions[k].solution.displacement});
      resting_at.push_back(open[k]);
    }
  }
  std::vector<Solution> polished = newton_.solve(resting);
  for (std::size_t k = 0; k < polished.size(); ++k) solutions[resting_at[k]] = std::move(polished[k]);
}

}  // namespace voussoir
