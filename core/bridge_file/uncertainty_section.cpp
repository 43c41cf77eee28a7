#include "core/bridge_file/uncertainty_section.h"

namespace voussoir {
namespace {

constexpr double kMostVariation = 1.0;  ///< beyond it a first order about the stated bridge says nothing

void read_variation(TomlSection& section, const char* key, double& target) {
  section.number(key, target, 0.0, kMostVariation);
}

void read_temperature(TomlSection& section, const char* key, double& target) {
  section.number(key, target, 0.0, 100.0);
}

constexpr char kUnevenStiffness[] = "epoch_unevenness_cv", kUnevenTemperature[] = "uneven_temperature_K";

/// Unevenness has no parameters of its own, beside which alone nothing could be told.
void read_unevenness(TomlSection& section, Uncertainty& uncertainty) {
  Uncertainty others = uncertainty;
  others.epoch_unevenness = others.uneven_temperature = 0.0;
  const bool is_alone = !is_uncertain(others);
  if (is_alone) uncertainty = others;
  read_variation(section, kUnevenStiffness, uncertainty.epoch_unevenness);
  read_temperature(section, kUnevenTemperature, uncertainty.uneven_temperature);
  for (const auto& [key, value] : {std::pair{kUnevenStiffness, uncertainty.epoch_unevenness},
                                   std::pair{kUnevenTemperature, uncertainty.uneven_temperature}})
    if (is_alone && value > 0.0) section.refuse(key, "expected 0, as all else is known exactly");
}

}  // namespace

Uncertainty read_uncertainty(TomlSection section) {
  Uncertainty uncertainty;
  read_variation(section, "joint_stiffness_cv", uncertainty.joint_stiffness);
  read_variation(section, "regional_stiffness_cv", uncertainty.regional_stiffness);
  read_variation(section, "common_stiffness_cv", uncertainty.common_stiffness);
  read_variation(section, "stiffness_ratio_cv", uncertainty.stiffness_ratio);
  read_variation(section, "friction_cv", uncertainty.friction);
  read_variation(section, "young_modulus_cv", uncertainty.young_modulus);
  read_variation(section, "density_cv", uncertainty.density);
  read_temperature(section, "temperature_K", uncertainty.temperature);
  section.number("foot_movement_m", uncertainty.foot_movement, 0.0, 1.0);
  section.number("foot_rotation_rad", uncertainty.foot_rotation, 0.0, 0.1);
  section.number("side_movement_m", uncertainty.side_movement, 0.0, 1.0);
  read_variation(section, "epoch_stiffness_cv", uncertainty.epoch_stiffness);
  read_unevenness(section, uncertainty);
  section.refuse_unknown_keys();
  return uncertainty;
}

}  // namespace voussoir
