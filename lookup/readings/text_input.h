#pragma once
/// @file Text files as users hand them over.

#include <filesystem>
#include <string>

namespace voussoir {

/// The whole file; the path "-" is the standard input. Throws InputError "name: ..., expected `expected`" for
/// a file that cannot be read or is larger than 4 MiB.
std::string read_text_input(const std::filesystem::path& path, const std::string& expected);

/// How messages call the file.
std::string input_name(const std::filesystem::path& path);

}  // namespace voussoir
