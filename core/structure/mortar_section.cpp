#include "core/structure/mortar_section.h"

#include <cmath>

namespace voussoir {
namespace {

/// Refuses what would break by itself, or be stronger in tension than Coulomb's line allows.
void check_strength(const TomlSection& section, const JointMaterial& joints, const MortarRegion& region) {
  const Mortar& mortar = region.mortar;
  const double normal = region.normal_stiffness.value_or(joints.normal_stiffness);
  const double tangential = region.tangential_stiffness.value_or(joints.tangential_stiffness);
  const double f_m = mortar.compressive_strength;
  const auto above = [&](const char* key, double energy, double stored, const char* formula) {
    if (energy <= stored)
      section.refuse(key, fmt::format("is {:g}: expected more than {} = {:g}: the joint would break at once",
                                      energy, formula, stored));
  };
  above("opening_energy_J_m2", mortar.opening_energy,
        0.5 * mortar.tensile_strength * mortar.tensile_strength / normal, "f_t^2 / (2 p_n)");
  above("slip_energy_J_m2", mortar.slip_energy, mortar.cohesion * mortar.cohesion / tangential, "c^2 / p_t");
  if (std::isfinite(mortar.crushing_energy))
    above("crushing_energy_J_m2", mortar.crushing_energy, f_m * f_m / normal,
          "f_m^2 / p_n of compressive_strength_Pa");
  const double least_cohesion = mortar.friction_coefficient() * mortar.tensile_strength;
  if (mortar.cohesion < least_cohesion)
    section.refuse("cohesion_Pa",
                   fmt::format("is {:g}: expected at least tan(friction_angle) tensile_strength_Pa = {:g}",
                               mortar.cohesion, least_cohesion));
}

void read_strength(TomlSection& section, const JointMaterial& joints, MortarRegion& region) {
  Mortar& mortar = region.mortar;
  const auto required = [&](const char* key, double& value) {
    section.require(key);
    section.positive(key, value);
  };
  required("tensile_strength_Pa", mortar.tensile_strength);
  required("opening_energy_J_m2", mortar.opening_energy);
  required("cohesion_Pa", mortar.cohesion);
  required("slip_energy_J_m2", mortar.slip_energy);
  mortar.friction_angle = joints.friction_angle;
  section.friction_angle(mortar.friction_angle, joints.friction_angle);
  section.positive("compressive_strength_Pa", mortar.compressive_strength);
  section.positive("crushing_energy_J_m2", mortar.crushing_energy);
  check_strength(section, joints, region);
}

void read_names(TomlSection& section, std::vector<std::string>& names) {
  names = section.texts("between");
  if (section.has("between") && names.size() != 2)
    section.refuse("between",
                   fmt::format("has {} names: expected two of roles or blocks, as in [\"ring\", \"wall\"]",
                               names.size()));
}

MortarRegion read_region(TomlSection section, const BridgeDescription& description) {
  MortarRegion region;
  section.flag("within_blocks", region.within_blocks);
  if (region.within_blocks && !description.wall.halved)
    section.refuse("within_blocks", "is true: expected halved = true in [wall] beside it");
  read_names(section, region.between);
  for (const auto& [key, target] : {std::pair{"normal_stiffness_Pa_per_m", &region.normal_stiffness},
                                    std::pair{"tangential_stiffness_Pa_per_m", &region.tangential_stiffness}})
    if (section.has(key))
      section.positive(key, target->emplace());
    else
      section.know(key);
  bool dry = false;
  section.flag("dry", dry);
  if (!dry) read_strength(section, description.joints, region);
  section.refuse_unknown_keys();
  return region;
}

}  // namespace

std::vector<MortarRegion> read_mortar(const toml::array& tables, const std::string& file,
                                      const BridgeDescription& description) {
  std::vector<MortarRegion> regions;
  for (const toml::node& node : tables)
    regions.push_back(read_region(TomlSection(file, node.as_table(), " in [[mortar]]"), description));
  return regions;
}

}  // namespace voussoir
