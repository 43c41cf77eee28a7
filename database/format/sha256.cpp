#include "database/format/sha256.h"

#include <openssl/evp.h>

#include "core/error.h"

namespace voussoir {
namespace {

EVP_MD_CTX* evp(void* context) {
  return static_cast<EVP_MD_CTX*>(context);
}

}  // namespace

std::string to_hexadecimal(const Sha256& hash) {
  std::string text;
  for (const std::uint8_t byte : hash) text += fmt::format("{:02x}", byte);
  return text;
}

void Sha256Stream::Free::operator()(void* context) const {
  EVP_MD_CTX_free(evp(context));
}

Sha256Stream::Sha256Stream() : context_(EVP_MD_CTX_new()) {
  if (!context_ || EVP_DigestInit_ex(evp(context_.get()), EVP_sha256(), nullptr) != 1)
    throw Failure("OpenSSL offers no SHA-256");
}

void Sha256Stream::add(ByteView bytes) {
  if (EVP_DigestUpdate(evp(context_.get()), bytes.data(), bytes.size()) != 1)
    throw Failure("OpenSSL could not compute a SHA-256");
}

Sha256 Sha256Stream::finish() {
  Sha256 hash{};
  if (EVP_DigestFinal_ex(evp(context_.get()), hash.data(), nullptr) != 1)
    throw Failure("OpenSSL could not compute a SHA-256");
  return hash;
}

Sha256 sha256(ByteView bytes) {
  Sha256Stream stream;
  stream.add(bytes);
  return stream.finish();
}

}  // namespace voussoir
