#pragma once
/// @file Damaged and forged databases, made from good ones. Half of them are forged: bytes of HDF5's own
/// structures are changed and the structure's checksum is put right again, so that the change reaches the
/// reader's inside.

#include <array>
#include <cstring>
#include <span>

#include "database/format/hdf5_format.h"
#include "tests/support/fuzzing.h"

namespace voussoir::test {

/// A structure of HDF5 that ends with its checksum.
struct FileStructure {
  std::size_t offset = 0;
  std::size_t size = 0;
};

/// A file as build-database writes it.
struct GoodDatabase {
  std::string bytes;
  std::vector<FileStructure> structures;
};

inline std::uint32_t checksum_of(const std::string& bytes, std::size_t offset, std::size_t size) {
  return hdf5_format::lookup3(std::as_bytes(std::span(bytes)).subspan(offset, size));
}

/// The size at which the checksum of what begins at `offset` is right, or 0.
inline std::size_t size_of_structure(const std::string& bytes, std::size_t offset) {
  constexpr std::size_t kLargest = 8192;
  for (std::size_t end = offset + 8; end + 4 <= bytes.size() && end < offset + kLargest; ++end) {
    std::uint32_t stored = 0;
    std::memcpy(&stored, bytes.data() + end, sizeof stored);
    if (checksum_of(bytes, offset, end - offset) == stored) return end + 4 - offset;
  }
  return 0;
}

inline GoodDatabase good_database(std::string bytes) {
  GoodDatabase good{std::move(bytes), {}};
  for (const char* signature : {"\x89HDF", "OHDR", "OCHK", "FAHD", "FADB"})
    for (std::size_t at = good.bytes.find(signature); at != std::string::npos;
         at = good.bytes.find(signature, at + 1))
      if (const std::size_t size = size_of_structure(good.bytes, at)) good.structures.push_back({at, size});
  return good;
}

inline void change_bits(std::string& bytes, const GoodDatabase&, Chance& chance) {
  for (std::size_t count = 1 + below(chance, 4); count > 0; --count) {
    char& byte = bytes[below(chance, bytes.size())];
    byte = static_cast<char>(byte ^ (1 << below(chance, 8)));
  }
}

inline void overwrite(std::string& bytes, const GoodDatabase&, Chance& chance) {
  const std::size_t size = 1 + below(chance, 64);
  const std::size_t at = below(chance, bytes.size() - size);
  const char filling = below(chance, 2) == 0 ? '\0' : '\xff';
  for (std::size_t i = 0; i < size; ++i)
    bytes[at + i] = below(chance, 3) == 0 ? static_cast<char>(chance()) : filling;
}

inline void copy_within(std::string& bytes, const GoodDatabase&, Chance& chance) {
  const std::string piece = bytes.substr(below(chance, bytes.size() - 512), 1 + below(chance, 512));
  bytes.replace(below(chance, bytes.size() - piece.size()), piece.size(), piece);
}

inline void cut(std::string& bytes, const GoodDatabase&, Chance& chance) {
  bytes.resize(below(chance, bytes.size()));
}

/// Numbers that readers stumble over, among them places of other structures (circles) and the size of the
/// file.
inline std::uint64_t awkward_number(const GoodDatabase& good, Chance& chance) {
  const std::array<std::uint64_t, 8> numbers = {0,
                                                1,
                                                ~std::uint64_t{0},
                                                good.bytes.size(),
                                                std::uint64_t{1} << below(chance, 64),
                                                good.structures[below(chance, good.structures.size())].offset,
                                                below(chance, good.bytes.size()),
                                                chance()};
  return numbers[below(chance, numbers.size())];
}

inline void repair(std::string& bytes, const FileStructure& structure) {
  const std::uint32_t right = checksum_of(bytes, structure.offset, structure.size - 4);
  std::memcpy(bytes.data() + structure.offset + structure.size - 4, &right, sizeof right);
}

/// The file with this byte at a place, and the checksum of the structure that it lies in put right.
inline std::string forged_at(const GoodDatabase& good, std::size_t place, char byte) {
  std::string bytes = good.bytes;
  bytes.at(place) = byte;
  for (const FileStructure& structure : good.structures)
    if (place >= structure.offset && place < structure.offset + structure.size) repair(bytes, structure);
  return bytes;
}

inline void forge(std::string& bytes, const GoodDatabase& good, Chance& chance) {
  const FileStructure& structure = good.structures[below(chance, good.structures.size())];
  for (std::size_t count = 1 + below(chance, 3); count > 0; --count) {
    const std::size_t width = std::size_t{1} << below(chance, 4);
    if (structure.size < 4 + width) continue;
    const std::size_t at = structure.offset + below(chance, structure.size - 3 - width);
    const std::uint64_t number = awkward_number(good, chance);
    std::memcpy(bytes.data() + at, &number, width);
  }
  repair(bytes, structure);
}

/// The good file after one of these changes.
inline std::string damaged_database(const GoodDatabase& good, Chance& chance) {
  constexpr std::array kChanges = {change_bits, overwrite, copy_within, cut, forge, forge, forge, forge};
  std::string bytes = good.bytes;
  kChanges[below(chance, kChanges.size())](bytes, good, chance);
  return bytes;
}

}  // namespace voussoir::test
