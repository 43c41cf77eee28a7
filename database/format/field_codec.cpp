#include "database/format/field_codec.h"

#include <libdeflate.h>

#include <cmath>
#include <limits>
#include <memory>
#include <new>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr int kDeflateLevel = 1;  // higher ones gain at most 2 %
constexpr std::size_t kWidth = sizeof(double);

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

/// What libdeflate allocates; one of each a thread.
template <class State>
State* allocated(State* state) {
  if (state == nullptr) throw std::bad_alloc();
  return state;
}

libdeflate_compressor* compressor() {
  thread_local const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> own(
      allocated(libdeflate_alloc_compressor(kDeflateLevel)), &libdeflate_free_compressor);
  return own.get();
}

libdeflate_decompressor* decompressor() {
  thread_local const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> own(
      allocated(libdeflate_alloc_decompressor()), &libdeflate_free_decompressor);
  return own.get();
}

}  // namespace

Field to_storage_precision(const Field& field) {
  return field.unaryExpr([](double value) { return rounded(value); });
}

Bytes pack_field(const Field& field) {
  const Bytes shuffled =
      shuffle(std::as_bytes(std::span(field.data(), static_cast<std::size_t>(field.size()))));
  Bytes packed(most_packed_bytes(field.cols()));
  const std::size_t size =
      libdeflate_zlib_compress(compressor(), shuffled.data(), shuffled.size(), packed.data(), packed.size());
  if (size == 0) throw Failure("a field could not be compressed");
  packed.resize(size);
  return packed;
}

std::optional<Field> unpack_field(ByteView packed, Eigen::Index nodes) {
  Bytes shuffled(raw_bytes(nodes));
  std::size_t used = 0;  // null in the place of the size: exactly as many bytes as there is room for
  const auto result = libdeflate_zlib_decompress_ex(decompressor(), packed.data(), packed.size(),
                                                    shuffled.data(), shuffled.size(), &used, nullptr);
  if (result != LIBDEFLATE_SUCCESS || used != packed.size()) return std::nullopt;
  Field field(2, nodes);
  unshuffle(shuffled,
            std::as_writable_bytes(std::span(field.data(), static_cast<std::size_t>(field.size()))));
  return field;
}

std::size_t most_packed_bytes(Eigen::Index nodes) {
  return libdeflate_zlib_compress_bound(nullptr, raw_bytes(nodes));
}

std::uint32_t crc32_of(ByteView bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

}  // namespace voussoir
