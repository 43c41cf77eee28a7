#include "core/random.h"

#include <bit>
#include <cmath>

namespace voussoir {
namespace {
constexpr std::uint64_t kMultiplier = 6364136223846793005ULL;
constexpr std::uint64_t kIncrement = 1442695040888963407ULL;
}  // namespace

Random::Random(std::uint64_t seed) : state_(seed + kIncrement) {
  bits();
}

std::uint32_t Random::bits() {
  const std::uint64_t old = state_;
  state_ = old * kMultiplier + kIncrement;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
  return std::rotr(shifted, static_cast<int>(old >> 59U));
}

double Random::uniform() {
  const std::uint64_t high = bits();
  return static_cast<double>(((high << 32U) | bits()) >> 11U) * 0x1p-53;
}

std::uint32_t Random::below(std::uint32_t bound) {
  const std::uint32_t surplus = (0U - bound) % bound;  // so many of the 2^32 values would be drawn too often
  for (;;) {
    const std::uint64_t product = static_cast<std::uint64_t>(bits()) * bound;
    if (static_cast<std::uint32_t>(product) >= surplus) return static_cast<std::uint32_t>(product >> 32U);
  }
}

double Random::gaussian() {
  for (;;) {
    const double x = 2.0 * uniform() - 1.0;
    const double y = 2.0 * uniform() - 1.0;
    const double square = x * x + y * y;
    if (square > 0.0 && square < 1.0) return x * std::sqrt(-2.0 * std::log(square) / square);
  }
}

std::uint64_t series_seed(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t mixed = seed + 0x9e3779b97f4a7c15u * (number + 1);
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
  return mixed ^ (mixed >> 31);
}

}  // namespace voussoir
