#include "core/text_file.h"

#include <fstream>

#include "core/error.h"

namespace voussoir {

std::string read_text(const std::filesystem::path& file, std::size_t largest, const std::string& expected) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError(fmt::format("{}: cannot be opened: expected {}", file.string(), expected));
  std::string text(largest + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest)
    throw InputError(fmt::format("{}: larger than {} bytes: expected {}", file.string(), largest, expected));
  return text;
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text && stream.flush())) throw Failure(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace voussoir
