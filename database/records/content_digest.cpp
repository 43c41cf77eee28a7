#include "database/records/content_digest.h"

#include "core/error.h"
#include "database/records/schema.h"

namespace voussoir {

Sha256 content_digest(const std::vector<DigestPart>& parts) {
  Sha256Stream hash;
  hash.add(fmt::format("{} {}\n", kFormatName, kSchemaVersion));
  for (const DigestPart& part : parts) {
    ByteWriter head;
    head.put_bytes(view_bytes(part.path));
    head.put(std::uint8_t{0});
    head.put(static_cast<std::uint64_t>(part.bytes.size()));
    hash.add(head.bytes());
    hash.add(part.bytes);
  }
  return hash.finish();
}

}  // namespace voussoir
