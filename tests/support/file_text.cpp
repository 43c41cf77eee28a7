#include "tests/support/file_text.h"

#include <fstream>
#include <iterator>

namespace voussoir::test {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace voussoir::test
