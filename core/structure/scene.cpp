#include "core/structure/scene.h"

#include <algorithm>
#include <charconv>

#include "core/error.h"

namespace voussoir {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// A whole number that fills the text, or -1.
int parse_count(std::string_view text) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? number : -1;
}

[[noreturn]] void refuse_index(BlockIndex index, const BlockLayout& layout) {
  const int count = layout.count_in_course(index.course);
  if (count == 0)
    throw InputError(
        fmt::format("there is no block {}: this bridge has no course {}", to_string(index), index.course));
  throw InputError(fmt::format("there is no block {}: course {} has positions 1 to {}", to_string(index),
                               index.course, count));
}

/// A block by its label, or by course and position with any spaces.
BlockId parse_block(std::string_view text, const BlockLayout& layout) {
  if (const auto id = layout.find_label(text)) return *id;
  const auto comma = text.find(',');
  const bool split = comma != std::string_view::npos;
  const BlockIndex index{split ? parse_count(trimmed(text.substr(0, comma))) : -1,
                         split ? parse_count(trimmed(text.substr(comma + 1))) : -1};
  if (index.course < 0 || index.position < 0)
    throw InputError(fmt::format("'{}' names no block: expected COURSE,POSITION such as 10,4{}", text,
                                 layout.size() > 0 && layout.blocks.front().index.course < 0
                                     ? fmt::format(" or a label such as {}", layout.blocks.front().label)
                                     : ""));
  const auto id = layout.find(index);
  if (!id) refuse_index(index, layout);
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
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('+', start), text.size());
    scene.removed.push_back(parse_block(trimmed(text.substr(start, end - start)), layout));
    start = end + 1;
  }
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
