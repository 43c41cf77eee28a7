#include "generator/scenes/scene_list.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "database/records/record_key.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostCombinations = 1'000'000;  ///< of one range: some hundred megabytes of scenes
constexpr std::size_t kMostScenes = 10'000'000;  ///< of a bridge: pairs of 4,472 blocks or triples of 392, a
                                                 ///< gigabyte of scenes

struct NumberRange {
  int first = 0;
  int last = 0;
  bool holds(int number) const { return number >= first && number <= last; }
};

[[noreturn]] void refuse(std::string_view item) {
  throw InputError(fmt::format(
      "--scenes: cannot read '{}': expected all, singles, pairs, triples, intact, a scene such as 10,4 or "
      "10,4+6,4, or a range such as 10,1..20 or 0,*",
      item));
}

int number_in(std::string_view text, std::string_view item) {
  const std::optional<int> number = parse_whole_number(text);
  if (!number) refuse(item);
  return *number;
}

/// "4", "4..9" or "*"
NumberRange parse_range(std::string_view text, std::string_view item) {
  if (text == "*") return {0, std::numeric_limits<int>::max()};
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) return {number_in(text, item), number_in(text, item)};
  return {number_in(trimmed(text.substr(0, dots)), item), number_in(trimmed(text.substr(dots + 2)), item)};
}

/// The blocks that "10,1..20" stands for.
std::vector<BlockId> matching_blocks(std::string_view text, std::string_view item,
                                     const BlockLayout& layout) {
  const auto parts = split(text, ',');
  if (parts.size() != 2) refuse(item);
  const NumberRange course = parse_range(parts[0], item);
  const NumberRange position = parse_range(parts[1], item);
  std::vector<BlockId> blocks;
  for (std::size_t i = 0; i < layout.size(); ++i)
    if (course.holds(layout.blocks[i].index.course) && position.holds(layout.blocks[i].index.position))
      blocks.push_back(BlockId{static_cast<std::int32_t>(i)});
  if (blocks.empty()) throw InputError(fmt::format("--scenes: '{}' names no block of this bridge", item));
  return blocks;
}

/// Every scene that takes one block from each choice.
std::vector<Scene> combinations(const std::vector<std::vector<BlockId>>& choices, std::string_view item) {
  std::vector<Scene> scenes = {Scene{}};
  for (const auto& choice : choices) {
    if (scenes.size() > kMostCombinations / choice.size())
      throw InputError(fmt::format("--scenes: '{}' stands for more than {} scenes", item, kMostCombinations));
    std::vector<Scene> longer;
    for (const Scene& scene : scenes)
      for (const BlockId block : choice)
        if (!scene.lacks(block)) {
          longer.push_back(scene);
          longer.back().removed.push_back(block);
        }
    scenes = std::move(longer);
  }
  for (Scene& scene : scenes) std::sort(scene.removed.begin(), scene.removed.end());
  return scenes;
}

std::vector<Scene> scenes_of_range(std::string_view item, const BlockLayout& layout) {
  std::vector<std::vector<BlockId>> choices;
  for (const std::string_view part : split(item, '+')) choices.push_back(matching_blocks(part, item, layout));
  auto scenes = combinations(choices, item);
  if (scenes.empty())
    throw InputError(fmt::format("--scenes: '{}' names no scene without a repeated block", item));
  return scenes;
}

/// All scenes with at most so many missing blocks.
std::vector<Scene> scenes_up_to(int most_missing, std::string_view item, const BlockLayout& layout) {
  std::size_t count = 1;  // of the largest sets
  for (std::size_t k = 0; k < static_cast<std::size_t>(most_missing); ++k)
    count = count * (layout.size() - std::min(k, layout.size())) / (k + 1);
  if (count > kMostScenes)
    throw InputError(
        fmt::format("--scenes: '{}' of a bridge with {} blocks stands for more than {} scenes: name fewer",
                    item, layout.size(), kMostScenes));
  return all_scenes(layout.size(), most_missing);
}

std::vector<Scene> scenes_of_item(std::string_view item, const BlockLayout& layout) {
  if (item == "singles") return scenes_up_to(1, item, layout);
  if (item == "all") return scenes_up_to(2, item, layout);
  if (item == "triples") return scenes_up_to(3, item, layout);
  if (item == "pairs") {
    auto scenes = scenes_up_to(2, item, layout);
    std::erase_if(scenes, [](const Scene& scene) { return scene.missing() != 2; });
    return scenes;
  }
  const bool range = item.find("..") != std::string_view::npos || item.find('*') != std::string_view::npos;
  if (range) return scenes_of_range(item, layout);
  return {parse_scene(item, layout)};
}

}  // namespace

std::vector<Scene> parse_scene_list(std::string_view text, const BlockLayout& layout) {
  std::vector<Scene> scenes;
  for (const std::string_view item : split(text, ';')) {
    if (item.empty()) refuse(text);
    const auto more = scenes_of_item(item, layout);
    scenes.insert(scenes.end(), more.begin(), more.end());
  }
  if (scenes.empty()) throw InputError(fmt::format("--scenes: '{}' names no scene of this bridge", text));
  return in_order(std::move(scenes));
}

std::vector<Scene> in_order(std::vector<Scene> scenes) {
  std::sort(scenes.begin(), scenes.end(), [](const Scene& first, const Scene& second) {
    return row_order(kNominalVariant, first.removed, kNominalVariant, second.removed) < 0;
  });
  scenes.erase(std::unique(scenes.begin(), scenes.end()), scenes.end());
  return scenes;
}

}  // namespace voussoir
