#include "database/format/hdf5_format.h"

#include <algorithm>
#include <string_view>

#include "core/error.h"
#include "database/format/hdf5_messages.h"

namespace voussoir::hdf5_format {
namespace {

constexpr std::uint64_t kLargestBlock =
    1 << 20;                     ///< [bytes] of an object header; those written have under 4 KB
constexpr int kMostBlocks = 16;  ///< that one object header goes on in
constexpr std::size_t kChecksumSize = sizeof(std::uint32_t);

/// `size` bytes of the file from `offset`.
ByteView part(ByteView file, std::uint64_t offset, std::uint64_t size) {
  if (offset > file.size() || size > file.size() - offset)
    refuse("a structure lies beyond the end of the file");
  return file.subspan(offset, size);
}

/// The first structure's signature cannot be printed.
std::string_view name_of(std::string_view signature) {
  return signature.starts_with('\x89') ? "superblock" : signature;
}

/// A structure that begins with this signature and ends with a checksum over all before it, without both.
ByteView checked(ByteView file, std::uint64_t offset, std::uint64_t size, std::string_view signature) {
  if (size < signature.size() + kChecksumSize) refuse("a structure is too small");
  const ByteView whole = part(file, offset, size);
  if (std::memcmp(whole.data(), signature.data(), signature.size()) != 0)
    refuse(fmt::format("no {} structure where one was expected", name_of(signature)));
  const ByteView content = whole.first(size - kChecksumSize);
  std::uint32_t stored = 0;
  std::memcpy(&stored, whole.last(kChecksumSize).data(), kChecksumSize);
  if (lookup3(content) != stored) refuse(fmt::format("checksum of a {} structure", name_of(signature)));
  return content.subspan(signature.size());
}

/// Where an object header goes on.
struct Continuation {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// The messages of one block of an object header.
void read_messages(ByteView block, bool numbered, ObjectHeader& header, std::vector<Continuation>& more) {
  Taker taker(block);
  const std::size_t head = numbered ? 6 : 4;
  while (taker.left() >= head) {
    const auto type = taker.take<std::uint8_t>();
    const auto size = taker.take<std::uint16_t>();
    const auto flags = taker.take<std::uint8_t>();
    if (numbered) taker.skip(2);
    const ByteView content = taker.bytes(size);
    if (type == kContinuationMessage) {
      Taker link(content);
      const auto offset = link.take<std::uint64_t>();
      more.push_back({offset, link.take<std::uint64_t>()});
    } else {
      read_message(type, flags, content, header);
    }
  }
}

/// Elements of a fixed array in the order of their chunks.
class FixedArray {
 public:
  FixedArray(ByteView file, std::uint64_t address, std::uint64_t count) : count_(count) {
    constexpr std::uint64_t kHeaderSize = 28;
    Taker header(checked(file, address, kHeaderSize, "FAHD"));
    const auto version = header.take<std::uint8_t>();
    const auto client = header.take<std::uint8_t>();
    width_ = header.take<std::uint8_t>();
    const auto page_bits = header.take<std::uint8_t>();
    const auto entries = header.take<std::uint64_t>();
    const auto block = header.take<std::uint64_t>();
    constexpr int kFiltered = 1;
    if (version != 0 || client != kFiltered || width_ < 13 || width_ > 20 || page_bits > 32)
      refuse("an index of chunks of another kind");
    if (entries != count || count > file.size() / width_) refuse("an index of chunks of another length");
    page_ = std::uint64_t{1} << page_bits;
    if (count_ <= page_)
      read_whole(file, block);
    else
      read_pages(file, block);
  }

  std::vector<ChunkPlace> places;

 private:
  static constexpr std::uint64_t kPrefix = 14;  ///< signature, version, client, address of the header

  void read_whole(ByteView file, std::uint64_t block) {
    read_elements(
        checked(file, block, kPrefix + count_ * width_ + kChecksumSize, "FADB").subspan(kPrefix - 4), count_);
  }

  void read_pages(ByteView file, std::uint64_t block) {
    const std::uint64_t pages = (count_ + page_ - 1) / page_;
    const std::uint64_t bitmap = (pages + 7) / 8;
    const std::uint64_t head = kPrefix + bitmap + kChecksumSize;
    const ByteView made = checked(file, block, head, "FADB").subspan(kPrefix - 4);
    std::uint64_t offset = block + head;  // within the file: the head was found there
    for (std::uint64_t page = 0; page < pages; ++page) {
      const std::uint64_t elements = std::min(page_, count_ - page * page_);
      const std::uint64_t size = elements * width_ + kChecksumSize;
      const bool is_made = (std::to_integer<unsigned>(made[page / 8]) & (0x80U >> (page % 8))) != 0;
      if (!is_made) refuse("an index of chunks with gaps");
      read_elements(checked(file, offset, size, ""), elements);
      offset += size;
    }
  }

  void read_elements(ByteView elements, std::uint64_t count) {
    Taker taker(elements);
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto offset = taker.take<std::uint64_t>();
      const auto size = taker.number(width_ - 12U);
      const auto skipped_filters = taker.take<std::uint32_t>();
      if (skipped_filters != 0) refuse("a chunk without its filters");
      places.push_back({offset, size});
    }
  }

  std::uint64_t count_;
  std::uint8_t width_ = 0;  ///< [bytes] of an element
  std::uint64_t page_ = 0;  ///< elements of a page
};

}  // namespace

std::uint64_t root_address(ByteView file) {
  constexpr std::uint64_t kSuperblockSize = 48;
  Taker superblock(checked(file, 0, kSuperblockSize, "\x89HDF\r\n\x1a\n"));
  const auto version = superblock.take<std::uint8_t>();
  const auto offset_size = superblock.take<std::uint8_t>();
  const auto length_size = superblock.take<std::uint8_t>();
  const auto flags = superblock.take<std::uint8_t>();
  const auto base = superblock.take<std::uint64_t>();
  const auto extension = superblock.take<std::uint64_t>();
  const auto end = superblock.take<std::uint64_t>();
  const auto root = superblock.take<std::uint64_t>();
  if (version < 2 || version > 3 || offset_size != 8 || length_size != 8 || base != 0 ||
      extension != kUndefined)
    refuse("a superblock of another kind");
  if (version == 3 && flags != 0) refuse("it was not closed by the program that wrote it");
  if (end > file.size()) refuse(fmt::format("{} bytes where {} were expected", file.size(), end));
  return root;
}

ObjectHeader read_object_header(ByteView file, std::uint64_t address) {
  constexpr std::uint64_t kLongestPrefix = 34;
  const std::uint64_t reach = address < file.size() ? std::min(kLongestPrefix, file.size() - address) : 0;
  Taker prefix(part(file, address, reach));
  prefix.skip(4);  // the signature is checked with the checksum
  const auto version = prefix.take<std::uint8_t>();
  const auto flags = prefix.take<std::uint8_t>();
  if (version != 2) refuse("an object header of another version");
  if ((flags & 0x20U) != 0) prefix.skip(16);  // times
  if ((flags & 0x10U) != 0) prefix.skip(4);   // when attributes leave the header
  const std::uint64_t size = prefix.number(std::size_t{1} << (flags & 3U));
  const std::uint64_t head = reach - prefix.left();
  if (size > kLargestBlock) refuse("an object header that is too large");

  ObjectHeader header;
  std::vector<Continuation> more;
  const bool numbered = (flags & 0x04U) != 0;
  read_messages(checked(file, address, head + size + kChecksumSize, "OHDR").subspan(head - 4), numbered,
                header, more);
  for (std::size_t i = 0; i < more.size(); ++i) {
    if (i >= kMostBlocks || more[i].size > kLargestBlock) refuse("an object header that is too large");
    read_messages(checked(file, more[i].offset, more[i].size, "OCHK"), numbered, header, more);
  }
  return header;
}

std::vector<ChunkPlace> read_chunk_places(ByteView file, const Chunked& dataset, std::uint64_t count) {
  std::vector<ChunkPlace> places;
  if (dataset.index == Chunked::Index::fixed_array)
    places = FixedArray(file, dataset.address, count).places;
  else if (count == 1)
    places = {{dataset.address, dataset.single_size}};
  else
    refuse("an index of chunks of another length");
  for (const ChunkPlace& place : places) static_cast<void>(part(file, place.offset, place.size));
  return places;
}

}  // namespace voussoir::hdf5_format
