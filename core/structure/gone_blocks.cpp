#include "core/structure/gone_blocks.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/structure/scene.h"

namespace voussoir {

std::vector<GoneBlock> take_out(const std::vector<std::string>& names, std::vector<Block>& blocks) {
  if (names.empty()) return {};
  const BlockLayout layout{blocks};
  Scene missing;
  try {
    missing = parse_scene(fmt::format("{}", fmt::join(names, "+")), layout);
  } catch (const InputError& error) {
    throw InputError(fmt::format("missing_blocks: {}", error.what()));
  }
  if (missing.removed.size() == blocks.size())
    throw InputError("missing_blocks: all blocks of the bridge are missing");
  std::vector<GoneBlock> gone;
  blocks.clear();
  for (std::size_t b = 0; b < layout.size(); ++b)
    if (missing.lacks(BlockId{static_cast<std::int32_t>(b)}))
      gone.push_back({blocks.size(), layout.blocks[b]});
    else
      blocks.push_back(layout.blocks[b]);
  return gone;
}

}  // namespace voussoir
