#include "database/format/field_codec.h"

#include <zlib.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr int kDeflateLevel = 1;  // higher levels gain a few per cent for several times the time
constexpr std::size_t kWidth = sizeof(double);

const Bytef* zlib_bytes(const std::byte* bytes) {
  return reinterpret_cast<const Bytef*>(bytes);
}

Bytef* zlib_bytes(std::byte* bytes) {
  return reinterpret_cast<Bytef*>(bytes);
}

std::size_t raw_bytes(Eigen::Index nodes) {
  return static_cast<std::size_t>(nodes) * 2 * kWidth;
}

double rounded(double value) {
  constexpr double kSteps = 1.0 / kStorageStep;
  if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
  return std::nearbyint(value * kSteps) * kStorageStep + 0.0;  // + 0.0 turns -0 into 0
}

/// All first bytes, then all second bytes, and so on.
Bytes shuffle(ByteView bytes) {
  const std::size_t count = bytes.size() / kWidth;
  Bytes shuffled(bytes.size());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t byte = 0; byte < kWidth; ++byte) shuffled[byte * count + i] = bytes[i * kWidth + byte];
  return shuffled;
}

void unshuffle(ByteView shuffled, std::span<std::byte> bytes) {
  const std::size_t count = bytes.size() / kWidth;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t byte = 0; byte < kWidth; ++byte) bytes[i * kWidth + byte] = shuffled[byte * count + i];
}

}  // namespace

Field to_storage_precision(const Field& field) {
  return field.unaryExpr([](double value) { return rounded(value); });
}

Bytes pack_field(const Field& field) {
  const Bytes shuffled =
      shuffle(std::as_bytes(std::span(field.data(), static_cast<std::size_t>(field.size()))));
  Bytes packed(compressBound(shuffled.size()));
  uLongf size = packed.size();
  if (compress2(zlib_bytes(packed.data()), &size, zlib_bytes(shuffled.data()), shuffled.size(),
                kDeflateLevel) != Z_OK)
    throw Failure("zlib could not compress a field");
  packed.resize(size);
  return packed;
}

std::optional<Field> unpack_field(ByteView packed, Eigen::Index nodes) {
  Bytes shuffled(raw_bytes(nodes));
  uLongf size = shuffled.size();
  uLong used = packed.size();
  const int status = uncompress2(zlib_bytes(shuffled.data()), &size, zlib_bytes(packed.data()), &used);
  if (status != Z_OK || size != shuffled.size() || used != packed.size()) return std::nullopt;
  Field field(2, nodes);
  unshuffle(shuffled,
            std::as_writable_bytes(std::span(field.data(), static_cast<std::size_t>(field.size()))));
  return field;
}

std::size_t most_packed_bytes(Eigen::Index nodes) {
  return compressBound(raw_bytes(nodes));
}

std::uint32_t crc32_of(ByteView bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, zlib_bytes(bytes.data()), bytes.size()));
}

}  // namespace voussoir
