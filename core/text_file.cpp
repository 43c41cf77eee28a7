#include "core/text_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "core/error.h"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";  // begins every HDF5 file

/// Of a name that nothing has, in the same folder.
fs::path new_file_beside(const fs::path& file) {
  std::string name = file.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0)
    throw Failure(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(errno)));
  ::close(descriptor);
  return name;
}

}  // namespace

void take_over_access(const fs::path& from, const fs::path& to) {
  struct stat old {
  }, now{};
  if (::stat(from.c_str(), &old) != 0) return;
  const bool is_given = ::chown(to.c_str(), old.st_uid, old.st_gid) == 0;
  const bool has_group = is_given || ::chown(to.c_str(), static_cast<uid_t>(-1), old.st_gid) == 0 ||
                         (::stat(to.c_str(), &now) == 0 && now.st_gid == old.st_gid);
  static_cast<void>(::chmod(to.c_str(), old.st_mode & (has_group ? 0777 : 0707)));
}

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

void check_output(const std::string& option, const fs::path& file, const std::vector<std::string>& endings,
                  std::span<const fs::path> read) {
  std::error_code none;
  const bool is_there = fs::exists(file, none), is_special = is_there && !fs::is_regular_file(file, none);
  if (is_special && !fs::is_directory(file, none)) return;  // a terminal, a pipe
  if (!endings.empty() && std::ranges::find(endings, file.extension().string()) == endings.end())
    throw InputError(fmt::format("{}: {}: expected a file that ends in {}", option, file.string(),
                                 fmt::join(endings, " or ")));
  if (!is_there || is_special) return;
  const auto refuse = [&](const char* what) {
    throw InputError(
        fmt::format("{}: {} {}, which would be lost: expected another file", option, file.string(), what));
  };
  for (const fs::path& other : read)
    if (fs::equivalent(file, other, none)) refuse("is read by this very command");
  std::string begin(kHdf5.size(), '\0');
  std::ifstream(file, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin == kHdf5) refuse("is a database");
  if (file.extension() == ".toml") refuse("is a bridge file");
}

/// Beside a file that is there first. What is begun and not finished goes, but for a terminal, a pipe or a
/// link.
void write_file(const fs::path& file, const std::string& text) {
  std::error_code none;
  const bool is_there = fs::exists(file, none), is_new = !fs::exists(fs::symlink_status(file, none));
  const fs::path target = is_there ? fs::canonical(file) : file;
  const bool replaces = fs::is_regular_file(target, none);
  const fs::path written = replaces ? new_file_beside(target) : target;
  errno = 0;
  std::ofstream stream(written, std::ios::binary);
  const bool done = static_cast<bool>(stream << text && stream.flush());
  const std::string reason = errno != 0 ? fmt::format(": {}", std::strerror(errno)) : "";
  stream.close();
  if (done && replaces) {
    take_over_access(target, written);
    fs::rename(written, target);
  }
  if (done) return;
  if (replaces || is_new) fs::remove(written, none);
  throw Failure(fmt::format("{}: cannot be written{}", file.string(), reason));
}

}  // namespace voussoir
