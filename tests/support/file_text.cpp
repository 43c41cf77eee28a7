#include "tests/support/file_text.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace voussoir::test {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error(path.string() + " cannot be opened");
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace voussoir::test
