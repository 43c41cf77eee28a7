#include "core/bridge_file/movements_section.h"

namespace voussoir {
namespace {

constexpr double kFurthest = 10.0;  ///< [m]
constexpr int kMostMovementSteps = 100000;

MovementDescription read_movement(TomlSection section) {
  MovementDescription movement;
  section.require("support");
  section.text("support", movement.support);
  if (section.has("pressure_Pa")) {
    section.positive("pressure_Pa", movement.pressure.emplace());
    for (const char* key : {"x_m", "y_m"})
      if (section.has(key)) section.refuse(key, "expected either pressure_Pa or a way x_m, y_m");
  } else {
    section.know("pressure_Pa");
    section.number("x_m", movement.x, -kFurthest, kFurthest);
    section.number("y_m", movement.y, -kFurthest, kFurthest);
    if (movement.x == 0.0 && movement.y == 0.0)
      section.refuse("support", "expected pressure_Pa, x_m or y_m beside it");
  }
  section.count("steps", movement.steps, 1, kMostMovementSteps);
  section.refuse_unknown_keys();
  return movement;
}

}  // namespace

std::vector<MovementDescription> read_movements(const toml::array& tables, const std::string& file) {
  std::vector<MovementDescription> movements;
  for (const toml::node& node : tables)
    movements.push_back(read_movement(TomlSection(file, node.as_table(), " in [[movements]]")));
  return movements;
}

}  // namespace voussoir
