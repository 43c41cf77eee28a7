#pragma once
/// @file Writing and reading plain little-endian values one after the other: the journal's records and what
/// checksums are taken over.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace voussoir {

static_assert(std::endian::native == std::endian::little, "files and checksums are defined little-endian");

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

/// Values with one meaning bit by bit, so that their memory can be written as it is.
template <class T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// The memory of a range of plain values.
template <class Range>
ByteView view_bytes(const Range& values) {
  return std::as_bytes(std::span(values));
}

/// Appends plain values to a growing buffer.
class ByteWriter {
 public:
  template <PlainValue T>
  void put(T value) {
    put_bytes(std::as_bytes(std::span(&value, 1)));
  }
  void put_bytes(ByteView bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

/// Takes values off the front of untrusted bytes; every read says whether there was enough.
class ByteReader {
 public:
  explicit ByteReader(ByteView bytes) : rest_(bytes) {}

  template <PlainValue T>
  std::optional<T> get() {
    const auto bytes = get_bytes(sizeof(T));
    if (!bytes) return std::nullopt;
    T value;
    std::memcpy(&value, bytes->data(), sizeof(T));
    return value;
  }

  std::optional<ByteView> get_bytes(std::size_t count) {
    if (count > rest_.size()) return std::nullopt;
    const ByteView front = rest_.first(count);
    rest_ = rest_.subspan(count);
    return front;
  }

  std::size_t left() const { return rest_.size(); }

 private:
  ByteView rest_;
};

}  // namespace voussoir
