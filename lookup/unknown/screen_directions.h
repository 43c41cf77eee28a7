#pragma once
/// @file The combinations of readings in which a screen looks at scenes.

#include <array>
#include <cstddef>

#include "core/simd/lower_triangle.h"

namespace voussoir {

/// How many of the directions are looked at.
enum class ScreenDirections : std::size_t { first = 4, few = 8, more = 16, all = 32 };
inline constexpr std::array kScreenDirections = {ScreenDirections::first, ScreenDirections::few,
                                                 ScreenDirections::more, ScreenDirections::all};
/// Where so many are in kScreenDirections.
constexpr std::size_t place_of(ScreenDirections directions) {
  std::size_t place = 0;
  while (kScreenDirections[place] != directions) ++place;
  return place;
}
inline constexpr auto kDirections = static_cast<std::size_t>(ScreenDirections::all);

using DirectionVector = std::array<double, kDirections>;
using DirectionTriangle = std::array<double, lower_size(kDirections)>;

}  // namespace voussoir
