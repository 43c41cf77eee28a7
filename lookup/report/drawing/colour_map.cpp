#include "lookup/report/drawing/colour_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

/// Every eighth entry of magma's 256, and its last.
constexpr std::array<std::uint32_t, 33> kMagma = {
    0x000004, 0x030312, 0x0a0822, 0x130d34, 0x1d1147, 0x29115a, 0x36106b, 0x440f76, 0x51127c,
    0x5d177f, 0x6a1c81, 0x762181, 0x832681, 0x902a81, 0x9c2e7f, 0xaa337d, 0xb73779, 0xc43c75,
    0xd0416f, 0xdc4869, 0xe75263, 0xef5d5e, 0xf56b5c, 0xf9795d, 0xfc8961, 0xfd9869, 0xfea772,
    0xfeb67c, 0xfec488, 0xfed395, 0xfde2a3, 0xfcf0b2, 0xfcfdbf};

// The ends of the map that are used: its palest colour stands out from white, its darkest from a dark page.
constexpr double kPalest = 0.97;
constexpr double kDarkest = 0.12;

std::uint8_t mixed(std::uint32_t low, std::uint32_t high, int shift, double part) {
  const double a = (low >> shift) & 0xFFU;
  const double b = (high >> shift) & 0xFFU;
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * part));
}

double share_of_level(int level) {
  return static_cast<double>(level) / (kColourLevels - 1);
}

/// The map at 0 (black) to 1 (pale). Values outside are clamped.
Colour magma(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(kMagma.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(place), kMagma.size() - 2);
  const double part = place - static_cast<double>(low);
  const std::uint32_t a = kMagma.at(low);
  const std::uint32_t b = kMagma.at(low + 1);
  return {mixed(a, b, 16, part), mixed(a, b, 8, part), mixed(a, b, 0, part)};
}

}  // namespace

std::string to_string(Colour colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

int colour_level(double share) {
  return std::clamp(static_cast<int>(share * kColourLevels), 0, kColourLevels - 1);
}

Colour light_colour(int level) {
  return magma(kPalest + (kDarkest - kPalest) * share_of_level(level));
}

Colour dark_colour(int level) {
  return magma(kDarkest + (kPalest - kDarkest) * share_of_level(level));
}

}  // namespace voussoir
