#pragma once
/// @file Whole texts from and to disk.

#include <filesystem>
#include <string>

namespace voussoir {

/// The whole text of a file. Throws InputError naming the file and what was `expected` if it cannot be opened
/// or is larger than `largest` bytes.
std::string read_text(const std::filesystem::path& file, std::size_t largest, const std::string& expected);

/// Writes a whole text to a file. Throws Failure naming the file if it cannot be written.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace voussoir
