#pragma once
/// @file Pages, pictures and tables on disk.

#include <filesystem>
#include <string>

namespace voussoir {

/// Writes a whole text to a file. Throws Failure naming the file if it cannot be written.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace voussoir
