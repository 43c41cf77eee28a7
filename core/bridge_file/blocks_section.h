#pragma once
/// @file The key `blocks` of a bridge file: blocks one by one, or the file that holds them.

#include <filesystem>

#include "core/bridge_file/toml_section.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// A bridge file with the blocks in place of the name of their file.
struct WithBlocks {
  std::string text;                ///< as a database keeps it
  toml::table root;                ///< the same, with the lines of the file that was given
  std::vector<std::string> notes;  ///< what was healed or left out
};

/// Parses the text. If it says blocks = "FILE" (.json, .dxf; relative to the folder of `path`), that file's
/// blocks are written out in its place; otherwise the text stays as it is. Throws InputError if the text is
/// no TOML or the file cannot be read.
WithBlocks with_blocks_of_file(const std::string& text, const std::filesystem::path& path);

/// Reads blocks = [{label = "1", role = "wall", ring = 0, vertices = [[x, y], ..]}, ..], heals and checks
/// them (assembly_check.h). Returns what was healed. Throws InputError "file:line: message" if they are no
/// assembly, or beside [wall], [[walls]] or [[spans]].
std::vector<std::string> read_blocks(TomlSection& top, BridgeDescription& description);

}  // namespace voussoir
