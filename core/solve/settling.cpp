#include "core/solve/settling.h"

#include <algorithm>
#include <utility>

namespace voussoir {
namespace {

/// [K] Of a bridge that does not jump this moves some micrometres, and back to less than one.
constexpr double kDisturbances[] = {-0.1, 0.0, 0.1, 0.0};

/// A bridge on its way.
struct Disturbed {
  std::size_t place;  ///< among the tasks
  Solution now;
  Eigen::Matrix2Xd slipped{};  ///< when the last step began
  bool jumped = false;
  bool stands = true;

  void go_on(Solution&& next) {
    stands = voussoir::stands(next);
    if (!stands) return;
    jumped = jumped || has_slipped(next);
    slipped = has_slipped(next) ? next.slipped : slip_of(now.memory);
    next.iterations += now.iterations;
    now = std::move(next);
  }
};

/// Under its weight alone, as it was built, and without mortar, of which no jumps are followed.
bool may_settle(const StageTask& task, const Solution& solution) {
  return task.before == nullptr && task.stage.scene.removed.empty() && stands(solution) &&
         std::ranges::none_of(solution.memory, [](const JointMemory& joint) { return !joint.bond.empty(); });
}

}  // namespace

std::vector<Solution> settle(std::span<const StageTask> tasks, std::vector<Solution> solutions,
                             const StageSolver& newton) {
  std::vector<Disturbed> bridges;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (may_settle(tasks[i], solutions[i])) bridges.push_back({.place = i, .now = solutions[i]});
  for (const double warmer : kDisturbances) {
    std::erase_if(bridges, [](const Disturbed& bridge) { return !bridge.stands; });
    std::vector<StageTask> stages;
    for (const Disturbed& bridge : bridges) {
      const StageTask& built = tasks[bridge.place];
      stages.push_back({.stage = built.stage,
                        .start = &bridge.now.displacement,
                        .before = &bridge.now,
                        .parameters = built.parameters});
      stages.back().stage.temperature += warmer;
    }
    std::vector<Solution> found = newton(stages);
    for (std::size_t i = 0; i < bridges.size(); ++i) bridges[i].go_on(std::move(found[i]));
  }
  for (Disturbed& bridge : bridges) {
    if (!bridge.stands || !bridge.jumped) continue;
    solutions[bridge.place] = std::move(bridge.now);
    solutions[bridge.place].slipped = std::move(bridge.slipped);
  }
  return solutions;
}

}  // namespace voussoir
