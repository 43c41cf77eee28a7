#include "core/structure/mortar_section.h"

#include <cmath>
#include <numbers>

namespace voussoir {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

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
  double degrees = joints.friction_angle / kDegree;
  section.number("friction_angle_deg", degrees, joints.friction_angle / kDegree, 89.0, true);
  mortar.friction_angle = degrees * kDegree;
  section.positive("compressive_strength_Pa", mortar.compressive_strength);
  section.positive("crushing_energy_J_m2", mortar.crushing_energy);
  const double normal = region.normal_stiffness.value_or(joints.normal_stiffness);
  const double tangential = region.tangential_stiffness.value_or(joints.tangential_stiffness);
  const double elastic_opening = 0.5 * mortar.tensile_strength * mortar.tensile_strength / normal;
  const double elastic_slip = mortar.cohesion * mortar.cohesion / tangential;
  const double least_cohesion = mortar.friction_coefficient() * mortar.tensile_strength;
  if (mortar.opening_energy <= elastic_opening)
    section.refuse(
        "opening_energy_J_m2",
        fmt::format("is {:g}: expected more than f_t^2 / (2 p_n) = {:g}, what is stored at the strength",
                    mortar.opening_energy, elastic_opening));
  if (mortar.slip_energy <= elastic_slip)
    section.refuse("slip_energy_J_m2",
                   fmt::format("is {:g}: expected more than c^2 / p_t = {:g}: the joint would break at once",
                               mortar.slip_energy, elastic_slip));
  const double elastic_crushing = mortar.compressive_strength * mortar.compressive_strength / normal;
  if (std::isfinite(mortar.crushing_energy) && !(mortar.crushing_energy > elastic_crushing))
    section.refuse(
        "crushing_energy_J_m2",
        fmt::format("is {:g}: expected more than f_m^2 / p_n = {:g} of compressive_strength_Pa: the "
                    "joint would break at once",
                    mortar.crushing_energy, elastic_crushing));
  if (mortar.cohesion < least_cohesion)
    section.refuse("cohesion_Pa",
                   fmt::format("is {:g}: expected at least tan(friction_angle) tensile_strength_Pa = {:g}",
                               mortar.cohesion, least_cohesion));
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
