#pragma once
/// @file A file's bytes in memory, read-only, loaded page by page as they are used.

#include <filesystem>
#include <utility>

#include "database/format/bytes.h"

namespace voussoir {

class MappedFile {
 public:
  /// Throws Failure if the file is missing or cannot be read. An empty file gives an empty view.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  MappedFile& operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  ByteView bytes() const { return bytes_; }

 private:
  ByteView bytes_;
};

}  // namespace voussoir
