#pragma once
/// @file The part of the HDF5 file format that build-database writes, read without the HDF5 library: files
/// may come from anywhere, and that library was not made for files that mean harm. Everything is read through
/// bounds checks, every structure's checksum is verified, and work and memory are bounded by the size of the
/// file. Source: "HDF5 File Format Specification Version 3.0", The HDF Group; names of structures are those
/// of that document.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/format/bytes.h"
#include "database/format/dataset_value.h"

namespace voussoir::hdf5_format {

/// Extents; none for a scalar.
using Shape = std::vector<std::uint64_t>;

/// The type of an element: `type` is empty for types that no database has.
struct StoredType {
  std::optional<ElementType> type;
  std::uint32_t width = 0;  ///< [bytes]
};

struct StoredAttribute {
  StoredType type;
  std::optional<Shape> shape;  ///< nothing: neither scalar nor simple
  ByteView value;
};

/// A dataset in one piece.
struct Contiguous {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// A dataset in chunks.
struct Chunked {
  enum class Index { single, fixed_array };
  Shape chunk;  ///< extents of a chunk and, last, the width of an element
  Index index = Index::single;
  std::uint64_t address = 0;      ///< of the one chunk or of the index
  std::uint64_t single_size = 0;  ///< of the one chunk in the file
};

/// What an object header says of a group or a dataset. Parts that are missing or are not as build-database
/// writes them are empty.
struct ObjectHeader {
  std::map<std::string, std::uint64_t, std::less<>> links;  ///< hard links to object headers
  std::map<std::string, StoredAttribute, std::less<>> attributes;
  std::optional<StoredType> type;
  std::optional<Shape> shape;
  std::optional<Contiguous> contiguous;
  std::optional<Chunked> chunked;
  std::vector<std::uint16_t> filters;
  bool external = false;  ///< the data lie in other files
};

struct ChunkPlace {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

inline constexpr std::uint16_t kDeflate = 1;
inline constexpr std::uint16_t kShuffle = 2;
inline constexpr std::uint64_t kUndefined = ~std::uint64_t{0};  ///< the address of nothing

/// The members of this namespace throw InputError in a few words, without the file's name.

/// Address of the root group. Reads superblocks of versions 2 and 3.
std::uint64_t root_address(ByteView file);

ObjectHeader read_object_header(ByteView file, std::uint64_t address);

/// Places of the `count` chunks of a dataset with filters, in the order of their numbers: the last extent
/// changes fastest.
std::vector<ChunkPlace> read_chunk_places(ByteView file, const Chunked& dataset, std::uint64_t count);

/// The checksum of HDF5's own structures: Bob Jenkins' lookup3 (hashlittle), initial value 0.
std::uint32_t lookup3(ByteView bytes);

}  // namespace voussoir::hdf5_format
