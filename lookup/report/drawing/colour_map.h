#pragma once
/// @file The colours of quantities: the map "magma" (van der Walt and Smith, matplotlib 1.5, 2015, public
/// domain) in a few levels. Equal steps look equally large, and its lightness alone tells them apart.

#include <array>
#include <cstdint>
#include <string>

namespace voussoir {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// "#rrggbb"
std::string to_string(Colour colour);

/// Quantities are drawn in this many levels. Elements of a level carry the class "m0", "m1".., which the
/// style sheet gives a colour: the higher the level, the further from the page's background, so dark on a
/// light page and pale on a dark one.
inline constexpr int kColourLevels = 20;

/// The level of a share between 0 and 1.
int colour_level(double share);

/// The colour of a level on a light and on a dark page.
Colour light_colour(int level);
Colour dark_colour(int level);

}  // namespace voussoir
