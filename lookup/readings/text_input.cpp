#include "lookup/readings/text_input.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr std::size_t kLargestFile = 4U << 20U;  // [bytes] far beyond any number of sensors

}  // namespace

std::string input_name(const std::filesystem::path& path) {
  return path == "-" ? "standard input" : path.string();
}

std::string read_text_input(const std::filesystem::path& path, const std::string& expected) {
  const auto failed = [&] {
    return InputError(
        at_line(input_name(path), 0,
                fmt::format("cannot be read ({}), expected {}", std::strerror(errno), expected)));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path == "-" ? "/dev/stdin" : path.c_str(), "rb"), &std::fclose);
  if (!file) throw failed();
  std::string text;
  std::array<char, 16384> chunk{};
  for (std::size_t got = 1; got > 0 && text.size() <= kLargestFile; text.append(chunk.data(), got))
    got = std::fread(chunk.data(), 1, chunk.size(), file.get());
  if (std::ferror(file.get()) != 0) throw failed();
  if (text.size() > kLargestFile)
    throw InputError(at_line(input_name(path), 0,
                             fmt::format("larger than {} MiB, expected {}", kLargestFile >> 20U, expected)));
  return text;
}

}  // namespace voussoir
