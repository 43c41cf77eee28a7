#include <array>

#include "database/format/hdf5_format.h"

namespace voussoir::hdf5_format {
namespace {

using Words = std::array<std::uint32_t, 3>;

constexpr std::size_t kBlock = sizeof(Words);

void add_block(Words& state, ByteView block) {
  Words words{};  // a block that is not full counts as if filled up with zeros
  std::memcpy(words.data(), block.data(), block.size());
  for (std::size_t i = 0; i < words.size(); ++i) state[i] += words[i];
}

void mix(Words& state) {
  auto& [a, b, c] = state;
  a -= c, a ^= std::rotl(c, 4), c += b;
  b -= a, b ^= std::rotl(a, 6), a += c;
  c -= b, c ^= std::rotl(b, 8), b += a;
  a -= c, a ^= std::rotl(c, 16), c += b;
  b -= a, b ^= std::rotl(a, 19), a += c;
  c -= b, c ^= std::rotl(b, 4), b += a;
}

void finish(Words& state) {
  auto& [a, b, c] = state;
  c ^= b, c -= std::rotl(b, 14);
  a ^= c, a -= std::rotl(c, 11);
  b ^= a, b -= std::rotl(a, 25);
  c ^= b, c -= std::rotl(b, 16);
  a ^= c, a -= std::rotl(c, 4);
  b ^= a, b -= std::rotl(a, 14);
  c ^= b, c -= std::rotl(b, 24);
}

}  // namespace

std::uint32_t lookup3(ByteView bytes) {
  const std::uint32_t start = 0xdeadbeefU + static_cast<std::uint32_t>(bytes.size());
  Words state = {start, start, start};
  if (bytes.empty()) return state[2];
  while (bytes.size() > kBlock) {
    add_block(state, bytes.first(kBlock));
    mix(state);
    bytes = bytes.subspan(kBlock);
  }
  add_block(state, bytes);
  finish(state);
  return state[2];
}

}  // namespace voussoir::hdf5_format
