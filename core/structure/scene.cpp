#include "core/structure/scene.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace voussoir {
namespace {

[[noreturn]] void refuse_index(BlockIndex index, const BlockLayout& layout) {
  const int last = layout.last_position(index.course);
  if (last == 0)
    throw InputError(
        fmt::format("there is no block {}: this bridge has no course {}", to_string(index), index.course));
  const bool gone = index.position >= 1 && index.position < last;
  throw InputError(fmt::format("there is no block {}: course {} has positions 1 to {}{}", to_string(index),
                               index.course, last, gone ? " without it (missing_blocks)" : ""));
}

/// A block by its label, or by course and position with any spaces.
BlockId parse_block(std::string_view text, const BlockLayout& layout) {
  if (const auto id = layout.find_label(text)) return *id;
  const auto numbers = split(text, ',');
  const auto course = parse_whole_number(numbers.front()), position = parse_whole_number(numbers.back());
  if (numbers.size() != 2 || !course || !position)
    throw InputError(fmt::format("'{}' names no block: expected COURSE,POSITION such as 10,4{}", text,
                                 layout.size() > 0 && layout.blocks.front().index.course < 0
                                     ? fmt::format(" or a label such as {}", layout.blocks.front().label)
                                     : ""));
  const auto id = layout.find({*course, *position});
  if (!id) refuse_index({*course, *position}, layout);
  return *id;
}

void append_scenes(std::size_t block_count, int missing, Scene& prefix, std::vector<Scene>& scenes) {
  if (prefix.missing() == missing) {
    scenes.push_back(prefix);
    return;
  }
  const std::size_t first =
      prefix.removed.empty() ? 0 : static_cast<std::size_t>(value(prefix.removed.back())) + 1;
  for (std::size_t block = first; block < block_count; ++block) {
    prefix.removed.push_back(BlockId{static_cast<std::int32_t>(block)});
    append_scenes(block_count, missing, prefix, scenes);
    prefix.removed.pop_back();
  }
}

}  // namespace

bool Scene::lacks(BlockId block) const {
  return std::find(removed.begin(), removed.end(), block) != removed.end();
}

Scene parse_scene(std::string_view text, const BlockLayout& layout) {
  Scene scene;
  if (trimmed(text) == "intact") return scene;
  for (const std::string_view block : split(text, '+')) scene.removed.push_back(parse_block(block, layout));
  std::sort(scene.removed.begin(), scene.removed.end());
  const auto repeated = std::adjacent_find(scene.removed.begin(), scene.removed.end());
  if (repeated != scene.removed.end())
    throw InputError(fmt::format("scene '{}' names block {} twice", text, layout[*repeated].label));
  return scene;
}

std::string to_string(const Scene& scene, const BlockLayout& layout) {
  if (scene.removed.empty()) return "intact";
  std::string text;
  for (const BlockId id : scene.removed) text += (text.empty() ? "" : "+") + layout[id].label;
  return text;
}

std::vector<Scene> all_scenes(std::size_t block_count, int most_missing) {
  std::vector<Scene> scenes;
  Scene prefix;
  for (int missing = 0; missing <= most_missing; ++missing)
    append_scenes(block_count, missing, prefix, scenes);
  return scenes;
}

}  // namespace voussoir
