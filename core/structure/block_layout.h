#pragma once
/// @file From the description of a bridge to its blocks.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/structure/bridge_description.h"
#include "core/structure/gone_blocks.h"
#include "core/structure/small_pieces.h"

namespace voussoir {

/// All blocks of a bridge. Laid by lay_blocks: arch blocks first, then the wall and the other parts course by
/// course, each from left to right.
struct BlockLayout {
  std::vector<Block> blocks;
  SmallPieces small_pieces{};     ///< what became of them
  std::vector<GoneBlock> gone{};  ///< known to be missing; control points are numbered as if they were there

  std::size_t size() const { return blocks.size(); }
  const Block& operator[](BlockId id) const { return blocks[static_cast<std::size_t>(id)]; }

  /// The block with this index or label, or nothing.
  std::optional<BlockId> find(BlockIndex index) const;
  std::optional<BlockId> find_label(std::string_view label) const;

  /// Throws InputError "where: ..." unless every name is a role's or the label of a block or of a missing
  /// one.
  void expect(const std::string& where, const std::vector<std::string>& names,
              const std::vector<std::string>& missing) const;

  /// Number of blocks that play this part.
  int count_with(BlockRole role) const;

  /// Position of the last block of a course (0 is the arch); not their number where some are known to be
  /// missing. 0 if there is no such course.
  int last_position(int course) const;
};

/// Lays the bridge's blocks (paper, Fig. 1): ring blocks of every span (make_arch), and the course rectangles
/// of the wall and of the other parts minus what the arches enclose. A rectangle cut in two gives two blocks;
/// pieces below a part's smallest block are joined to a neighbour. Course 0 holds the rings, innermost first;
/// the courses of the parts go on counting where the wall's end. Throws InputError if no block is left.
BlockLayout lay_blocks(const BridgeDescription& description);

}  // namespace voussoir
