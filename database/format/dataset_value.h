#pragma once
/// @file A dataset as values: what is written to a file and what one is compared with.

#include <string>
#include <vector>

#include "database/format/bytes.h"

namespace voussoir {

/// Little-endian in the file; text is UTF-8 of fixed width, padded with zeros.
enum class ElementType { float64, int32, int16, int8, uint8, uint32, text };

/// Bytes of an element; of text: of one character.
constexpr std::size_t width_of(ElementType type) {
  switch (type) {
    case ElementType::float64:
      return 8;
    case ElementType::int32:
    case ElementType::uint32:
      return 4;
    case ElementType::int16:
      return 2;
    case ElementType::int8:
    case ElementType::uint8:
    case ElementType::text:
      break;
  }
  return 1;
}

/// A whole dataset as it stands in the file.
struct DatasetValue {
  std::string path;
  ElementType type;
  std::vector<std::uint64_t> shape;  ///< empty for a scalar
  std::size_t text_width = 0;        ///< bytes of an element of type text
  std::string units;                 ///< "m", "1", "text"...
  std::string meaning;
  Bytes bytes;
  ByteView elsewhere{};  ///< what has its bytes somewhere else, which outlives this, has none of its own

  ByteView content() const { return elsewhere.empty() ? ByteView(bytes) : elsewhere; }
};

inline constexpr std::uint64_t kFlat = 0;  ///< columns of a dataset of rank 1

/// A dataset of these numbers: rows of `columns` of them, or rank 1 for kFlat.
template <class T>
DatasetValue dataset_of(const char* path, ElementType type, const std::vector<T>& values,
                        std::uint64_t columns, const char* units, const char* meaning) {
  const ByteView bytes = view_bytes(values);
  DatasetValue result{path, type, {values.size()}, 0, units, meaning, {bytes.begin(), bytes.end()}};
  if (columns != kFlat) result.shape = {values.size() / columns, columns};
  return result;
}

}  // namespace voussoir
