#include "core/structure/sensor_description.h"

#include <algorithm>
#include <array>
#include <utility>

namespace voussoir {
namespace {

constexpr std::array<std::pair<Quantity, std::string_view>, 4> kNames = {
    {{Quantity::ux, "ux"}, {Quantity::uy, "uy"}, {Quantity::tilt, "tilt"}, {Quantity::distance, "distance"}}};

}  // namespace

std::string_view to_string(Quantity quantity) {
  return std::ranges::find(kNames, quantity, &std::pair<Quantity, std::string_view>::first)->second;
}

std::optional<Quantity> parse_quantity(std::string_view text) {
  for (const auto& [quantity, name] : kNames)
    if (name == text) return quantity;
  return std::nullopt;
}

}  // namespace voussoir
