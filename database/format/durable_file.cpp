#include "database/format/durable_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/text_file.h"
#include "database/format/file_descriptor.h"

namespace voussoir {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw Failure(fmt::format("{}: could not be written to the disk: {}", path.string(), std::strerror(errno)));
}

void synchronise(const FileDescriptor& file, const std::filesystem::path& path) {
  if (!file || ::fsync(file.get()) != 0) fail(path);
}

}  // namespace

void put_in_place(const std::filesystem::path& finished, const std::filesystem::path& target) {
  const FileDescriptor file(::open(finished.c_str(), O_RDWR | O_CLOEXEC));
  if (!file) fail(finished);
  take_over_access(target, finished);  // which may be one that nobody may write to
  synchronise(file, finished);
  std::error_code error;
  std::filesystem::rename(finished, target, error);
  if (error)
    throw Failure(fmt::format("{}: could not be given the name {}: {}", finished.string(), target.string(),
                              error.message()));
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  synchronise(FileDescriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)), folder);
}

std::filesystem::path behind_links(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  const std::filesystem::path given = path;
  for (int links = 0; std::filesystem::is_symlink(path); ++links) {
    if (links == kMostLinks)
      throw Failure(fmt::format("{}: more than {} symbolic links, expected some that lead to a file",
                                given.string(), kMostLinks));
    path = path.parent_path() / std::filesystem::read_symlink(path);  // the latter alone if it is absolute
  }
  return path;
}

}  // namespace voussoir
