#pragma once
/// @file What a file says of a sensor.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/geometry/polygon.h"

namespace voussoir {

enum class Quantity {
  ux,       ///< displacement to the right [m]
  uy,       ///< displacement up [m]
  tilt,     ///< rotation of a block [rad], counter-clockwise
  distance  ///< how much longer the way between two places becomes [m]
};

/// A sensor as a bridge file or a table of sensors describes it.
struct SensorDescription {
  std::string name;
  Quantity quantity = Quantity::uy;
  std::optional<Point> from{};  ///< [m] its place; of a distance one of two
  std::optional<Point> to{};    ///< [m] the other place of a distance
  std::string block{};          ///< as in scenes ("10,4"), where blocks meet; of a tilt instead of a place
  std::string to_block{};       ///< the same for the other place
};

/// Names are short, as databases keep them [bytes].
inline constexpr std::size_t kLongestSensorName = 8;

/// As files write them.
const std::vector<std::pair<const char*, Quantity>>& quantity_names();
/// "ux", "uy", "tilt" or "distance".
std::string_view to_string(Quantity quantity);
/// Nothing for another text.
std::optional<Quantity> parse_quantity(std::string_view text);
inline constexpr std::string_view kQuantities = "ux, uy, tilt or distance";

}  // namespace voussoir
