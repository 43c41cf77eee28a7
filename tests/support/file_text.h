#pragma once
/// @file What a file holds.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace voussoir::test {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace voussoir::test
