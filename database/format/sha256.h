#pragma once
/// @file SHA-256 (FIPS 180-4, by OpenSSL).

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "database/format/bytes.h"

namespace voussoir {

using Sha256 = std::array<std::uint8_t, 32>;

/// 64 lower-case hexadecimal digits.
std::string to_hexadecimal(const Sha256& hash);

/// Hash of data that comes in pieces.
class Sha256Stream {
 public:
  Sha256Stream();
  void add(ByteView bytes);
  void add(std::string_view text) { add(view_bytes(text)); }
  /// The hash of everything added. The stream cannot be used afterwards.
  Sha256 finish();

 private:
  struct Free {
    void operator()(void* context) const;
  };
  std::unique_ptr<void, Free> context_;
};

Sha256 sha256(ByteView bytes);
inline Sha256 sha256(std::string_view text) {
  return sha256(view_bytes(text));
}

}  // namespace voussoir
