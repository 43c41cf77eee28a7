#pragma once
/// @file Blocks from other programs: JSON, and files by their endings (DXF: dxf_blocks.h).

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/structure/block.h"

namespace voussoir {

struct BlockFile {
  std::vector<Block> blocks;       ///< as they stand in the file, unchecked
  std::vector<std::string> notes;  ///< what was left out
};

/// Reads a file by its ending, .json or .dxf. Throws InputError naming the file, the place in it and what was
/// expected.
BlockFile read_block_file(const std::filesystem::path& path);

/// {"blocks": [{"label": "1", "role": "ring", "ring": 0, "vertices": [[x, y], ..]}, ..]}; lengths in metres;
/// label (default: the number of the block), role (default: wall) and ring may be left out. `name` is for
/// messages.
BlockFile parse_json_blocks(std::string_view text, const std::string& name);

}  // namespace voussoir
