#pragma once
/// @file A scene: which blocks are missing.

#include <string>
#include <string_view>
#include <vector>

#include "core/structure/block_layout.h"

namespace voussoir {

/// A set of removed blocks, in ascending order. Empty: the intact bridge.
struct Scene {
  std::vector<BlockId> removed;

  bool lacks(BlockId block) const;
  int missing() const { return static_cast<int>(removed.size()); }
  friend auto operator<=>(const Scene&, const Scene&) = default;
};

/// Reads "intact", "10,4" or "10,4+6,4" (spaces allowed). Blocks may be named in any order.
/// Throws InputError naming the text and what was expected for bad syntax, unknown or repeated blocks.
Scene parse_scene(std::string_view text, const BlockLayout& layout);

/// "intact", "10,4", "6,4+10,4": the inverse of parse_scene.
std::string to_string(const Scene& scene, const BlockLayout& layout);

/// Intact, all singles, all pairs (up to `most_missing` removed blocks), in that order, lexicographic within.
std::vector<Scene> all_scenes(std::size_t block_count, int most_missing);

}  // namespace voussoir
