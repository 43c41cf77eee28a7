#include "generator/scenes/build_plan.h"

#include <algorithm>
#include <map>

#include "core/structure/mirror_symmetry.h"
#include "generator/scenes/start_field.h"

namespace voussoir {
namespace {

constexpr int kStages = 4;  // intact; singles; pairs; the rest

int stage_of(const Scene& scene) {
  return std::min(scene.missing(), kStages - 1);
}

/// The scene that is solved for this one, and this one if that is another.
std::pair<Scene, std::optional<Scene>> solved_and_image(const RecordKey& key, const PlanBasis& basis) {
  const Model& bridge = basis.bridges[static_cast<std::size_t>(key.variant)];
  Scene solved = representative(key.scene, bridge, basis.rules);
  const bool is_image = solved != key.scene;
  return {std::move(solved), is_image ? std::optional(key.scene) : std::nullopt};
}

/// The keys that need a record and have none: those wanted that are unknown and what they start from.
std::set<RecordKey> missing_records(const std::vector<RecordKey>& wanted, const PlanBasis& basis,
                                    const KnownKeys& known) {
  std::set<RecordKey> missing;
  for (const RecordKey& key : wanted)
    if (!known.has_record(key)) missing.insert(missing.end(), key);
  std::set<RecordKey> starting;  // that were looked at
  std::vector<RecordKey> added(missing.begin(), missing.end());
  while (!added.empty()) {  // what starts others starts from scenes with fewer missing blocks
    std::vector<RecordKey> more;
    for (const RecordKey& key : added) {
      const auto [solved, image] = solved_and_image(key, basis);
      for (const Scene& start : starting_scenes(solved, image, basis.rules, basis.states)) {
        const auto [place, is_new] = starting.insert({key.variant, start});
        if (is_new && !known.can_start(*place) && missing.insert(*place).second) more.push_back(*place);
      }
    }
    added = std::move(more);
  }
  return missing;
}

/// Calls visit(number of the shard, key) for each record that is solved, as shards share them out.
template <class Visit>
void deal(const std::vector<RecordKey>& wanted, const PlanBasis& basis, int count, const Visit& visit) {
  const std::set<RecordKey> whole(wanted.begin(), wanted.end());
  const auto nothing = [](const RecordKey&) { return false; };
  int dealt = 0;
  for (const auto& stage : plan_build(wanted, basis, {nothing, nothing}).stages)
    for (const SolvingTask& task : stage) {
      std::vector<RecordKey> own;
      if (task.records_solved) own.push_back({task.variant, task.solved});
      if (task.image) own.push_back({task.variant, *task.image});
      std::erase_if(own, [&](const RecordKey& key) { return !whole.contains(key); });
      if (own.empty()) continue;
      for (const RecordKey& key : own) visit(dealt % count + 1, key);
      ++dealt;
    }
}

}  // namespace

Scene representative(const Scene& scene, const Model& bridge, const PlanRules& rules) {
  const bool mirrors = rules.mirror_images && bridge.symmetry;
  return mirrors ? std::min(scene, mirrored(scene, *bridge.symmetry)) : scene;
}

std::set<Scene> starting_scenes(const Scene& solved, const std::optional<Scene>& image,
                                const PlanRules& rules, const StatePlan& states) {
  std::set<Scene> scenes;
  const auto add = [&](const Scene& scene) {
    if (!rules.warm_starts && rules.collapse_fields && !place_of_lost(states) &&
        !((rules.inherited || rules.composed) && scene.missing() > 2))
      return;
    for (Scene& subset : starting_subsets(scene)) scenes.insert(std::move(subset));
  };
  add(solved);
  if (image && has_one_sided_loads(states)) add(*image);
  return scenes;
}

std::size_t BuildPlan::records() const {
  std::size_t count = 0;
  for (const auto& stage : stages)
    for (const SolvingTask& task : stage) count += (task.records_solved ? 1 : 0) + (task.image ? 1 : 0);
  return count;
}

BuildPlan plan_build(const std::vector<RecordKey>& wanted, const PlanBasis& basis, const KnownKeys& known) {
  std::map<RecordKey, SolvingTask> tasks;
  for (const RecordKey& key : missing_records(wanted, basis, known)) {
    auto [solved, image] = solved_and_image(key, basis);
    SolvingTask& task = tasks[{key.variant, solved}];
    task.variant = key.variant;
    task.solved = std::move(solved);
    if (image)
      task.image = std::move(image);
    else
      task.records_solved = true;
  }
  BuildPlan plan;
  plan.stages.resize(kStages);
  for (auto& [key, task] : tasks)
    plan.stages[static_cast<std::size_t>(stage_of(key.scene))].push_back(std::move(task));
  return plan;
}

int most_missing_of_starts(const std::vector<RecordKey>& wanted) {
  const bool several =
      std::ranges::any_of(wanted, [](const RecordKey& key) { return key.scene.missing() > 2; });
  return several ? 2 : 1;
}

std::vector<RecordKey> keys_of_shard(const std::vector<RecordKey>& wanted, const PlanBasis& basis,
                                     const Shard& shard) {
  std::set<RecordKey> keys = {{kNominalVariant, Scene{}}};
  deal(wanted, basis, shard.count, [&](int number, const RecordKey& key) {
    if (number == shard.number) keys.insert(key);
  });
  return {keys.begin(), keys.end()};
}

Shard shard_with(const RecordKey& key, const std::vector<RecordKey>& wanted, const PlanBasis& basis,
                 int count) {
  Shard shard{1, count};  // every one has the intact bridge
  deal(wanted, basis, count, [&](int number, const RecordKey& dealt) {
    if (dealt == key) shard.number = number;
  });
  return shard;
}

}  // namespace voussoir
