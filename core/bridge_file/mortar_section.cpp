#include "core/bridge_file/mortar_section.h"

#include <optional>

#include "core/structure/mortar_limits.h"

namespace voussoir {
namespace {

/// What the joints' stiffness decides is checked here only if that is known already: regions may give joints
/// another one (lay_mortar).
void check_strength(const TomlSection& section, const BridgeDescription& description,
                    const MortarRegion& region) {
  JointMaterial joint = description.joints;
  joint.mortar = region.mortar;
  joint.normal_stiffness = region.normal_stiffness.value_or(joint.normal_stiffness);
  joint.tangential_stiffness = region.tangential_stiffness.value_or(joint.tangential_stiffness);
  const bool is_known =
      description.regions.empty() || (region.normal_stiffness && region.tangential_stiffness);
  std::optional<RefusedMortar> refused = is_known ? refused_energy(joint) : std::nullopt;
  if (!refused) refused = refused_cohesion(region.mortar);
  if (refused) section.refuse(refused->key, refused->reason);
}

void read_strength(TomlSection& section, const BridgeDescription& description, MortarRegion& region) {
  Mortar& mortar = region.mortar;
  const auto required = [&](const char* key, double& value) {
    section.require(key);
    section.positive(key, value);
  };
  required("tensile_strength_Pa", mortar.tensile_strength);
  required("opening_energy_J_m2", mortar.opening_energy);
  required("cohesion_Pa", mortar.cohesion);
  required("slip_energy_J_m2", mortar.slip_energy);
  mortar.friction_angle = description.joints.friction_angle;
  section.friction_angle(mortar.friction_angle, description.joints.friction_angle);
  section.positive("compressive_strength_Pa", mortar.compressive_strength);
  section.positive("crushing_energy_J_m2", mortar.crushing_energy);
  check_strength(section, description, region);
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
  if (!dry) read_strength(section, description, region);
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
