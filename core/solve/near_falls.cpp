#include "core/solve/near_falls.h"

namespace voussoir {
namespace {

/// Of missing blocks that move. Three take 1.6 times as long and find hardly any more falls.
constexpr int kNeighbours = 2;
constexpr double kMostOfBridge = 0.5;  ///< that a patch is

}  // namespace

std::optional<Solution> fall_nearby(const StageTask& task, const DynamicSolver& motion,
                                    const DecisionRules& rules) {
  const Scene& scene = task.stage.scene;
  if (scene.missing() == 0 || task.before != nullptr || task.start == nullptr) return std::nullopt;
  const Patch patch = motion.patch_around(scene, kNeighbours);
  if (patch.share_of_blocks() > kMostOfBridge) return std::nullopt;
  Solution found = motion.solve_in(patch, scene, without_nan(*task.start), patch_rules(rules));
  if (found.outcome != Outcome::collapsed) return std::nullopt;
  return found;
}

}  // namespace voussoir
