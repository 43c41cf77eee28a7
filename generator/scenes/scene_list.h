#pragma once
/// @file The value of --scenes: which scenes to build.

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/structure/scene.h"

namespace voussoir {

/// Reads a list of items separated by ';'. An item is
///   all       intact, all singles and all pairs,
///   singles   intact and all singles,
///   pairs     all pairs,
///   triples   all sets of three blocks, with what they are made of: intact, all singles and all pairs,
///   intact    the bridge without missing blocks,
///   a scene   10,4 or 10,4+6,4 or 10,4+6,4+2,1,
///   a range   as a scene, with from..to or * for a course or a position: 10,1..20   0,*   10,4+2..4,*
///             stands for every scene that it can be read as; combinations that name a block twice are left
///             out.
/// The scenes come back in the order of all_scenes, each once. Throws InputError naming the item and what was
/// expected; a range that matches no scene and one with more than a million combinations are errors, too.
std::vector<Scene> parse_scene_list(std::string_view text, const BlockLayout& layout);

/// Sorts scenes into the order of all_scenes (few missing blocks first, then lexicographic); repeated ones
/// are dropped.
std::vector<Scene> in_order(std::vector<Scene> scenes);

/// So many of them, evenly spread from the first to the last; all if there are fewer.
template <class Value>
std::vector<Value> evenly_chosen(const std::vector<Value>& values, std::size_t most) {
  const std::size_t count = std::min(most, values.size());
  std::vector<Value> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(values[(2 * i + 1) * values.size() / (2 * count)]);
  return chosen;
}

}  // namespace voussoir
