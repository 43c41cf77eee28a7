#include "generator/scenes/start_field.h"

#include <algorithm>

#include "core/solve/state_plan.h"

namespace voussoir {
namespace {

/// The sum of StartingFields::start_for; `part_of` finds what the intact bridge and the parts of the scene
/// that stand have of what is summed up, null for others.
template <class PartOf>
std::optional<Field> summed_up(const Scene& scene, const PartOf& part_of) {
  const Field* intact = part_of(Scene{});
  if (scene.removed.empty() || intact == nullptr) return std::nullopt;
  Field sum = *intact;
  if (scene.missing() == 1) return sum;
  for (const BlockId block : scene.removed)
    if (const Field* single = part_of(Scene{{block}})) sum += *single - *intact;
  for (const Scene& pair : starting_subsets(scene)) {
    const Field* both = pair.missing() == 2 ? part_of(pair) : nullptr;
    if (both == nullptr) continue;
    const Field* first = part_of(Scene{{pair.removed.front()}});
    const Field* second = part_of(Scene{{pair.removed.back()}});
    if (first != nullptr && second != nullptr) sum += *both - *first - *second + *intact;
  }
  return without_nan(sum);
}

}  // namespace

std::vector<Scene> starting_subsets(const Scene& scene) {
  std::vector<Scene> subsets;
  if (!scene.removed.empty()) subsets.emplace_back();
  if (scene.missing() > 1)
    for (const BlockId block : scene.removed) subsets.push_back(Scene{{block}});
  if (scene.missing() > 2)
    for (std::size_t i = 0; i < scene.removed.size(); ++i)
      for (std::size_t j = i + 1; j < scene.removed.size(); ++j)
        subsets.push_back(Scene{{scene.removed[i], scene.removed[j]}});
  return subsets;
}

void StartingFields::add(const Scene& scene, std::size_t state, const Solution& solution) {
  if (scene.missing() > 2) return;
  if (solution.outcome == Outcome::standing) standing_[{scene, state}] = solution.displacement;
  if (state == kBuilt && stands(solution) && has_slipped(solution)) slipped_[scene] = solution.slipped;
  if (solution.outcome == Outcome::collapsed) falling_[{scene, state}] = solution.moving;
  if (solution.outcome == Outcome::unresolved) open_.emplace(scene, state);
}

bool StartingFields::falls_likely(const Scene& scene, std::size_t state) const {
  const auto is_there = [&](BlockId block) { return !std::ranges::binary_search(scene.removed, block); };
  return std::ranges::any_of(starting_subsets(scene), [&](const Scene& fewer) {
    const std::vector<BlockId>* falling = find_falling(fewer, state);
    return falling != nullptr && std::ranges::any_of(*falling, is_there);
  });
}

bool StartingFields::falls_by_one(const Scene& scene, std::size_t state) const {
  if (scene.missing() != 2 || intact(state) == nullptr || !falls_likely(scene, state)) return false;
  return std::ranges::count_if(scene.removed,
                               [&](BlockId block) { return find(Scene{{block}}, state) != nullptr; }) == 1;
}

bool StartingFields::open_likely(const Scene& scene, std::size_t state) const {
  return std::ranges::any_of(starting_subsets(scene), [&](const Scene& fewer) {
    return open_.contains({fewer, state});
  });
}

const std::vector<BlockId>* StartingFields::find_falling(const Scene& scene, std::size_t state) const {
  const auto found = falling_.find({scene, state});
  return found == falling_.end() ? nullptr : &found->second;
}

const Field* StartingFields::find(const Scene& scene, std::size_t state) const {
  const auto found = standing_.find({scene, state});
  return found == standing_.end() ? nullptr : &found->second;
}

Eigen::Matrix2Xd StartingFields::slipped(const Scene& scene) const {
  const auto found = slipped_.find(scene);
  return found == slipped_.end() ? Eigen::Matrix2Xd() : found->second;
}

std::vector<Scene> StartingFields::standing_singles(std::size_t state) const {
  std::vector<Scene> singles;
  for (const auto& [place, field] : standing_)
    if (place.first.missing() == 1 && place.second == state) singles.push_back(place.first);
  return singles;
}

std::vector<std::pair<Scene, std::vector<BlockId>>> StartingFields::falling(std::size_t state) const {
  std::vector<std::pair<Scene, std::vector<BlockId>>> scenes;
  for (const auto& [place, moving] : falling_)
    if (place.second == state) scenes.emplace_back(place.first, moving);
  std::ranges::stable_sort(scenes, {}, [](const auto& scene) { return scene.first.missing(); });
  return scenes;
}

bool StartingFields::has_pairs() const {
  const auto is_pair = [](const auto& entry) { return entry.first.first.missing() == 2; };
  return std::ranges::any_of(standing_, is_pair) || std::ranges::any_of(falling_, is_pair) ||
         std::ranges::any_of(open_, [](const Place& place) { return place.first.missing() == 2; });
}

std::optional<Field> StartingFields::start_for(const Scene& scene, std::size_t state) const {
  return summed_up(scene, [&](const Scene& part) { return find(part, state); });
}

Eigen::Matrix2Xd StartingFields::slipped_for(const Scene& scene) const {
  if (slipped_.empty()) return {};
  const Field none = Field::Zero(2, slipped_.begin()->second.cols());
  const auto sum = summed_up(scene, [&](const Scene& part) -> const Field* {
    if (find(part, kBuilt) == nullptr) return nullptr;
    const auto known = slipped_.find(part);
    return known == slipped_.end() ? &none : &known->second;
  });
  return !sum || sum->isZero(0.0) ? Field() : *sum;
}

std::optional<Field> StartingFields::change(const Scene& scene, std::size_t before, std::size_t after) const {
  const Field* from = find(scene, before);
  const Field* to = find(scene, after);
  return from == nullptr || to == nullptr ? std::nullopt : std::optional<Field>(*to - *from);
}

Field StartingFields::start_after(const Scene& scene, const Field& own, std::size_t before,
                                  std::size_t after) const {
  const auto intact_change = scene.removed.empty() ? std::nullopt : change(Scene{}, before, after);
  if (!intact_change) return without_nan(own);
  Field start = own + *intact_change;
  for (const BlockId block : scene.removed) {
    const auto single = scene.missing() > 1 ? change(Scene{{block}}, before, after) : std::nullopt;
    if (single) start += *single - *intact_change;
  }
  return without_nan(start);
}

}  // namespace voussoir
