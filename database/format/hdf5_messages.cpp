#include "database/format/hdf5_messages.h"

#include <algorithm>

#include "core/error.h"

namespace voussoir::hdf5_format {
namespace {

enum MessageType : std::uint8_t {
  kDataspace = 0x01,
  kLinkInfo = 0x02,
  kDatatype = 0x03,
  kLink = 0x06,
  kExternalFiles = 0x07,
  kLayout = 0x08,
  kFilters = 0x0b,
  kAttribute = 0x0c,
  kAttributeInfo = 0x15
};

constexpr std::uint8_t kShared = 0x02;  ///< flag: the message's content is elsewhere

/// Nothing for kinds and ranks that no database has.
std::optional<Shape> dataspace(ByteView content) {
  constexpr int kHighestRank = 4;
  Taker taker(content);
  const auto version = taker.take<std::uint8_t>();
  const auto rank = taker.take<std::uint8_t>();
  taker.skip(1);  // whether greatest extents follow
  const auto kind = taker.take<std::uint8_t>();
  constexpr int kScalar = 0;
  constexpr int kSimple = 1;
  if (version != 2 || kind > kSimple || rank > kHighestRank || (rank == 0) != (kind == kScalar))
    return std::nullopt;
  Shape shape;
  for (int i = 0; i < rank; ++i) shape.push_back(taker.take<std::uint64_t>());
  return shape;
}

bool equal(ByteView bytes, std::initializer_list<int> expected) {
  return std::equal(bytes.begin(), bytes.end(), expected.begin(), expected.end(),
                    [](std::byte byte, int number) { return std::to_integer<int>(byte) == number; });
}

/// Bit fields and properties of the types that databases have, as the file has them.
StoredType datatype(ByteView content) {
  Taker taker(content);
  const auto class_and_version = taker.take<std::uint8_t>();
  const ByteView bits = taker.bytes(3);
  const auto width = taker.take<std::uint32_t>();
  const ByteView properties = taker.bytes(taker.left());
  const auto is = [&](int kind, std::initializer_list<int> kind_bits,
                      std::initializer_list<int> kind_properties) {
    const auto fitting = properties.first(std::min(properties.size(), kind_properties.size()));
    return (class_and_version & 0x0fU) == static_cast<unsigned>(kind) && equal(bits, kind_bits) &&
           equal(fitting, kind_properties);
  };
  constexpr int kInteger = 0;
  constexpr int kFloat = 1;
  if (width == 8 && is(kFloat, {0x20, 63, 0}, {0, 0, 64, 0, 52, 11, 0, 52, 0xff, 3, 0, 0}))
    return {ElementType::float64, width};
  if (width == 4 && is(kInteger, {8, 0, 0}, {0, 0, 32, 0})) return {ElementType::int32, width};
  if (width == 2 && is(kInteger, {8, 0, 0}, {0, 0, 16, 0})) return {ElementType::int16, width};
  if (width == 1 && is(kInteger, {8, 0, 0}, {0, 0, 8, 0})) return {ElementType::int8, width};
  if (width == 4 && is(kInteger, {0, 0, 0}, {0, 0, 32, 0})) return {ElementType::uint32, width};
  if (width == 1 && is(kInteger, {0, 0, 0}, {0, 0, 8, 0})) return {ElementType::uint8, width};
  constexpr unsigned kString = 3;
  if ((class_and_version & 0x0fU) == kString && width > 0) return {ElementType::text, width};
  return {std::nullopt, width};
}

/// Hard links only: the file may not send the reader to other files or round in circles.
void link(ByteView content, ObjectHeader& header) {
  Taker taker(content);
  const auto version = taker.take<std::uint8_t>();
  const auto flags = taker.take<std::uint8_t>();
  const bool is_hard = (flags & 0x08U) == 0 || taker.take<std::uint8_t>() == 0;
  if (version != 1 || !is_hard) return;
  if ((flags & 0x04U) != 0) taker.skip(8);  // order of creation
  if ((flags & 0x10U) != 0) taker.skip(1);  // character set
  const std::uint64_t length = taker.number(std::size_t{1} << (flags & 3U));
  const ByteView name = taker.bytes(length);
  header.links.emplace(std::string(reinterpret_cast<const char*>(name.data()), name.size()),
                       taker.take<std::uint64_t>());
}

void attribute(ByteView content, ObjectHeader& header) {
  Taker taker(content);
  const auto version = taker.take<std::uint8_t>();
  const auto flags = taker.take<std::uint8_t>();
  const auto name_size = taker.take<std::uint16_t>();
  const auto type_size = taker.take<std::uint16_t>();
  const auto space_size = taker.take<std::uint16_t>();
  taker.skip(1);  // character set
  if (version != 3 || flags != 0) return;
  const ByteView name = taker.bytes(name_size);
  const StoredType type = datatype(taker.bytes(type_size));
  const auto shape = dataspace(taker.bytes(space_size));
  const std::string text(reinterpret_cast<const char*>(name.data()), name.size());
  header.attributes.emplace(text.substr(0, text.find('\0')),
                            StoredAttribute{type, shape, taker.bytes(taker.left())});
}

Chunked chunked_layout(Taker& taker) {
  constexpr int kSingleChunk = 1;
  constexpr int kFixedArray = 3;
  constexpr std::uint8_t kSingleWithFilter = 0x02;
  constexpr std::size_t kMostExtents = 5;  // of the highest rank, and the width of an element
  Chunked chunked;
  const auto flags = taker.take<std::uint8_t>();
  const auto extents = taker.take<std::uint8_t>();
  const auto width = taker.take<std::uint8_t>();
  if (extents > kMostExtents || width < 1 || width > 8) refuse("chunks of another kind");
  for (int i = 0; i < extents; ++i) chunked.chunk.push_back(taker.number(width));
  const auto index = taker.take<std::uint8_t>();
  if (index == kFixedArray) {
    chunked.index = Chunked::Index::fixed_array;
    taker.skip(1);  // size of pages, which the array itself says, too
  } else if (index == kSingleChunk && (flags & kSingleWithFilter) != 0) {
    chunked.single_size = taker.take<std::uint64_t>();
    if (taker.take<std::uint32_t>() != 0) refuse("a chunk without its filters");
  } else {
    refuse("chunks of another kind");
  }
  chunked.address = taker.take<std::uint64_t>();
  return chunked;
}

void layout(ByteView content, ObjectHeader& header) {
  constexpr int kContiguous = 1;
  constexpr int kChunked = 2;
  Taker taker(content);
  const auto version = taker.take<std::uint8_t>();
  const auto kind = taker.take<std::uint8_t>();
  if (kind == kContiguous && (version == 3 || version == 4)) {
    const auto offset = taker.take<std::uint64_t>();
    header.contiguous = Contiguous{offset, taker.take<std::uint64_t>()};
  } else if (kind == kChunked && version == 4) {
    header.chunked = chunked_layout(taker);
  }
}

void filters(ByteView content, ObjectHeader& header) {
  constexpr std::uint16_t kLastWithoutName = 255;
  Taker taker(content);
  const auto version = taker.take<std::uint8_t>();
  const auto count = taker.take<std::uint8_t>();
  if (version != 2) refuse("filters of another kind");
  for (int i = 0; i < count; ++i) {
    const auto filter = taker.take<std::uint16_t>();
    if (filter > kLastWithoutName) refuse("filters of another kind");
    taker.skip(2);  // flags
    taker.skip(std::size_t{4} * taker.take<std::uint16_t>());
    header.filters.push_back(filter);
  }
}

/// Links and attributes may lie outside of the header; those of databases do not.
void refuse_heap(ByteView content, std::size_t index_size) {
  Taker taker(content);
  taker.skip(1);  // version
  if ((taker.take<std::uint8_t>() & 1U) != 0) taker.skip(index_size);
  if (taker.take<std::uint64_t>() != kUndefined)
    refuse(
        "links or attributes outside of their object header, as older versions and other programs write "
        "them: build the "
        "database again");
}

}  // namespace

void refuse(const std::string& why) {
  throw InputError(why);
}

void read_message(std::uint8_t type, std::uint8_t flags, ByteView content, ObjectHeader& header) {
  if ((flags & kShared) != 0) return;
  switch (type) {
    case kDataspace:
      header.shape = dataspace(content);
      break;
    case kLinkInfo:
      refuse_heap(content, 8);
      break;
    case kDatatype:
      header.type = datatype(content);
      break;
    case kLink:
      link(content, header);
      break;
    case kExternalFiles:
      header.external = true;
      break;
    case kLayout:
      layout(content, header);
      break;
    case kFilters:
      filters(content, header);
      break;
    case kAttribute:
      attribute(content, header);
      break;
    case kAttributeInfo:
      refuse_heap(content, 2);
      break;
    default:
      break;
  }
}

}  // namespace voussoir::hdf5_format
