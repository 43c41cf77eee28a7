#pragma once
/// @file One hash over everything that a database says about its bridge.

#include "database/format/sha256.h"
#include "database/records/schema.h"

namespace voussoir {

/// A dataset as the digest sees it.
struct DigestPart {
  std::string_view path;
  ByteView bytes;
};

/// SHA-256 over kFormatName, a blank, kSchemaVersion and a line end and then, for each part, its path, a zero
/// byte, its size in bytes as uint64 and its bytes. The parts are the shared datasets in their order and
/// scenes/checksum, which stands for all that is kept of the scenes. How and when the file was written does
/// not enter: chunk storage, compression, program version and compiler may differ between files of equal
/// digest.
Sha256 content_digest(const std::vector<DigestPart>& parts);

/// How many figures of a digest people see.
inline constexpr std::size_t kDigestShown = 12;

}  // namespace voussoir
