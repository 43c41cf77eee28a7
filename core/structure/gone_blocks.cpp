#include "core/structure/gone_blocks.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace voussoir {

std::vector<GoneBlock> take_out(const std::vector<std::string>& labels, std::vector<Block>& blocks) {
  for (auto label = labels.begin(); label != labels.end(); ++label) {
    if (std::ranges::find(blocks, *label, &Block::label) == blocks.end())
      throw InputError(
          fmt::format("missing_blocks: '{}' is no block: expected labels of blocks, such as \"{}\"", *label,
                      blocks.front().label));
    if (std::find(labels.begin(), label, *label) != label)
      throw InputError(fmt::format("missing_blocks: '{}' comes twice", *label));
  }
  std::vector<GoneBlock> gone;
  std::vector<Block> left;
  for (Block& block : blocks)
    if (std::ranges::find(labels, block.label) == labels.end())
      left.push_back(std::move(block));
    else
      gone.push_back({left.size(), std::move(block)});
  if (left.empty()) throw InputError("missing_blocks: all blocks of the bridge are missing");
  blocks = std::move(left);
  return gone;
}

}  // namespace voussoir
