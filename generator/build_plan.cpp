#include "generator/build_plan.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/structure/mirror_symmetry.h"

namespace voussoir {
namespace {

constexpr int kStages = 3;  // intact; singles; the rest

int stage_of(const Scene& scene) {
  return std::min(scene.missing(), kStages - 1);
}

/// The keys that need a record and have none: those wanted that are unknown and what they start from.
std::set<RecordKey> missing_records(const std::vector<RecordKey>& wanted, std::span<const Model> bridges,
                                    const PlanRules& rules,
                                    const std::function<bool(const RecordKey&)>& is_known) {
  std::set<RecordKey> missing;
  for (const RecordKey& key : wanted)
    if (!is_known(key)) missing.insert(missing.end(), key);
  for (int pass = 1; pass < kStages; ++pass)  // pairs start from singles, singles from the intact bridge
    for (const auto& [variant, scene] : std::vector<RecordKey>(missing.begin(), missing.end())) {
      const Model& bridge = bridges[static_cast<std::size_t>(variant)];
      for (const Scene& start : starting_scenes(representative(scene, bridge, rules), rules))
        if (!is_known({variant, start})) missing.insert({variant, start});
    }
  return missing;
}

}  // namespace

Scene representative(const Scene& scene, const Model& bridge, const PlanRules& rules) {
  const bool mirrors = rules.mirror_images && bridge.symmetry;
  return mirrors ? std::min(scene, mirrored(scene, *bridge.symmetry)) : scene;
}

std::vector<Scene> starting_scenes(const Scene& solved, const PlanRules& rules) {
  std::vector<Scene> scenes;
  if (!rules.warm_starts) return scenes;
  if (!solved.removed.empty()) scenes.push_back(Scene{});
  if (solved.missing() > 1)
    for (const BlockId block : solved.removed) scenes.push_back(Scene{{block}});
  return scenes;
}

std::size_t BuildPlan::records() const {
  std::size_t count = 0;
  for (const auto& stage : stages)
    for (const SolvingTask& task : stage) count += (task.records_solved ? 1 : 0) + (task.image ? 1 : 0);
  return count;
}

BuildPlan plan_build(const std::vector<RecordKey>& wanted, std::span<const Model> bridges,
                     const PlanRules& rules, const std::function<bool(const RecordKey&)>& is_known) {
  std::map<RecordKey, SolvingTask> tasks;
  for (const auto& [variant, scene] : missing_records(wanted, bridges, rules, is_known)) {
    const Scene solved = representative(scene, bridges[static_cast<std::size_t>(variant)], rules);
    SolvingTask& task = tasks[{variant, solved}];
    task.variant = variant;
    task.solved = solved;
    if (scene == solved)
      task.records_solved = true;
    else
      task.image = scene;
  }
  BuildPlan plan;
  plan.stages.resize(kStages);
  for (auto& [key, task] : tasks)
    plan.stages[static_cast<std::size_t>(stage_of(key.scene))].push_back(std::move(task));
  return plan;
}

}  // namespace voussoir
