#include "core/structure/sensor_description.h"

#include <algorithm>

namespace voussoir {

const std::vector<std::pair<const char*, Quantity>>& quantity_names() {
  static const std::vector<std::pair<const char*, Quantity>> names = {
      {"ux", Quantity::ux}, {"uy", Quantity::uy}, {"tilt", Quantity::tilt}, {"distance", Quantity::distance}};
  return names;
}

std::string_view to_string(Quantity quantity) {
  return std::ranges::find(quantity_names(), quantity, &std::pair<const char*, Quantity>::second)->first;
}

std::optional<Quantity> parse_quantity(std::string_view text) {
  for (const auto& [name, quantity] : quantity_names())
    if (name == text) return quantity;
  return std::nullopt;
}

}  // namespace voussoir
