#pragma once
/// @file What a file holds.

#include <filesystem>
#include <string>

namespace voussoir::test {

/// Throws std::runtime_error if it cannot be opened.
std::string text_of(const std::filesystem::path& path);

}  // namespace voussoir::test
