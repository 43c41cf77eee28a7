#pragma once
/// @file The messages of HDF5's object headers.

#include "database/format/hdf5_format.h"

namespace voussoir::hdf5_format {

inline constexpr std::uint8_t kContinuationMessage = 0x10;

[[noreturn]] void refuse(const std::string& why);

/// Takes numbers off the front of a structure; throws InputError if it ends too soon.
class Taker {
 public:
  explicit Taker(ByteView bytes) : reader_(bytes) {}

  template <PlainValue T>
  T take() {
    const auto value = reader_.get<T>();
    if (!value) refuse("a structure ends too soon");
    return *value;
  }

  ByteView bytes(std::size_t count) {
    const auto found = reader_.get_bytes(count);
    if (!found) refuse("a structure ends too soon");
    return *found;
  }

  /// A whole number of 1 to 8 bytes.
  std::uint64_t number(std::size_t width) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes(width).data(), width);
    return value;
  }

  void skip(std::size_t count) { static_cast<void>(bytes(count)); }
  std::size_t left() const { return reader_.left(); }

 private:
  ByteReader reader_;
};

/// Enters into `header` what a message of this type and with these flags says. Messages that databases do
/// without are passed over.
void read_message(std::uint8_t type, std::uint8_t flags, ByteView content, ObjectHeader& header);

}  // namespace voussoir::hdf5_format
