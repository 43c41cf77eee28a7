#pragma once
/// @file Bridge files (TOML).

#include <filesystem>
#include <string>
#include <string_view>

#include "core/structure/bridge_description.h"

namespace voussoir {

/// A bridge file's whole text and what it says.
struct BridgeFile {
  std::string name;  ///< path, for messages
  std::string text;  ///< with the blocks of a file that it names in place of that file's name
  BridgeDescription description;
  std::vector<std::string> notes{};  ///< what was healed or left out of a file of blocks, and what is so
                                     ///< unusual that another unit may have been meant, in sentences
};

/// Reads a bridge file. Every key is optional and defaults to the reference bridge's value; unknown keys,
/// wrong types and impossible values throw InputError "file:line: message".
BridgeFile read_bridge_file(const std::filesystem::path& path);

/// The same for a text already in memory (`name` is used in messages). It opens no other file: blocks have to
/// stand in the text itself.
BridgeFile parse_bridge_file(std::string_view text, const std::string& name);

/// examples/bridges/reference.toml as it was when the program was built.
BridgeFile reference_bridge_file();

}  // namespace voussoir
