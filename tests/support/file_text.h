#pragma once
/// @file What a file holds.

#include <filesystem>
#include <string>

namespace voussoir::test {

std::string text_of(const std::filesystem::path& path);

}  // namespace voussoir::test
