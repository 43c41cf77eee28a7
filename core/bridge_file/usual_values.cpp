#include "core/bridge_file/usual_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace voussoir {
namespace {

/// What bridges of masonry and soil have, widely taken: a factor of a thousand shows, an odd stone does not.
struct UsualRange {
  std::string_view key;
  double least, most;
  std::string_view guess;  ///< what a number outside may have been meant in
};

constexpr std::array<UsualRange, 15> kUsual = {
    {{"density_kg_m3", 500.0, 10000.0, "t/m3 or kN/m3?"},
     {"unit_weight_N_m3", 5000.0, 100000.0, "kN/m3 or kg/m3?"},
     {"friction_angle_deg", 5.0, 80.0, "radians, or a coefficient of friction?"},
     {"young_modulus_Pa", 1e6, 1e12, "GPa, MPa or kPa?"},
     {"normal_stiffness_Pa_per_m", 1e6, 1e14, "GPa/m or MPa/m?"},
     {"tangential_stiffness_Pa_per_m", 1e6, 1e14, "GPa/m or MPa/m?"},
     {"force_N", 100.0, 1e7, "kN?"},
     {"force_N_per_m", 100.0, 1e7, "kN/m?"},
     {"thickness_m", 0.01, 50.0, "mm?"},
     {"ring_thickness_m", 0.01, 10.0, "mm?"},
     {"course_height_m", 0.01, 10.0, "mm?"},
     {"block_length_m", 0.01, 20.0, "mm?"},
     {"foot_movement_m", 1e-6, 0.1, "mm?"},
     {"side_movement_m", 1e-6, 0.1, "mm?"},
     {"foot_rotation_rad", 1e-8, 0.02, "degrees, or mm per m?"}}};

void add_note(const toml::key& key, const toml::node& node, std::vector<std::string>& notes) {
  const auto usual = std::ranges::find(kUsual, key.str(), &UsualRange::key);
  const auto number = node.value<double>();
  if (usual == kUsual.end() || !number || *number == 0.0) return;
  if (*number < usual->least || *number > usual->most)
    notes.push_back(fmt::format("line {}: {} = {:g}: usual are {:g} to {:g}; {}", key.source().begin.line,
                                usual->key, *number, usual->least, usual->most, usual->guess));
}

void add_notes(const toml::table& table, std::vector<std::string>& notes) {
  for (const auto& [key, node] : table) {
    add_note(key, node, notes);
    if (const toml::table* const within = node.as_table()) add_notes(*within, notes);
    const toml::array* const entries = key.str() == "blocks" ? nullptr : node.as_array();
    if (entries == nullptr) continue;
    for (const toml::node& entry : *entries)
      if (const toml::table* const within = entry.as_table()) add_notes(*within, notes);
  }
}

}  // namespace

std::vector<std::string> unusual_values(const toml::table& table) {
  std::vector<std::string> notes;
  add_notes(table, notes);
  return notes;
}

}  // namespace voussoir
