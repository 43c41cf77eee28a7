#include "core/bridge_file/materials_section.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostSurfacePoints = 1000;

void read_material_keys(TomlSection& section, Material& material) {
  section.positive("young_modulus_Pa", material.young_modulus);
  section.number("poisson_ratio", material.poisson_ratio, 0.0, 0.49);
  section.positive("density_kg_m3", material.density);
  section.positive("thickness_m", material.thickness);
  section.choice("plane", material.plane, {{"stress", PlaneState::stress}, {"strain", PlaneState::strain}});
  section.number("thermal_expansion_per_K", material.thermal_expansion, 0.0, 1e-3);
}

void read_joint_keys(TomlSection& section, JointMaterial& joints) {
  section.positive("normal_stiffness_Pa_per_m", joints.normal_stiffness);
  section.positive("tangential_stiffness_Pa_per_m", joints.tangential_stiffness);
  section.friction_angle(joints.friction_angle, 0.0);
}

}  // namespace

void read_material(TomlSection section, Material& material) {
  read_material_keys(section, material);
  section.refuse_unknown_keys();
}

void read_joints(TomlSection section, JointMaterial& joints, double& tolerance) {
  read_joint_keys(section, joints);
  section.positive("tolerance_m", tolerance, 0.1);
  section.refuse_unknown_keys();
}

Region read_region(TomlSection section, const Material& material, const JointMaterial& joints) {
  Region region{{}, material, joints};
  section.require("of");
  region.of = section.texts("of");
  read_material_keys(section, region.material);
  read_joint_keys(section, region.joints);
  section.refuse_unknown_keys();
  return region;
}

void read_fill(TomlSection section, FillWeight& fill) {
  section.positive("unit_weight_N_m3", fill.unit_weight);
  double level = 0.0;
  section.number("level_m", level, 0.0, kLargestLength);
  fill.surface = section.points("surface_m", 2, kMostSurfacePoints);
  const bool has_surface = !fill.surface.empty();
  if (section.has("level_m")) {
    if (has_surface) section.refuse("level_m", "expected it or surface_m, not both");
    fill.surface = {{-kLargestLength, level}, {kLargestLength, level}};
  }
  if (section.has("unit_weight_N_m3") && fill.surface.empty())
    section.refuse("unit_weight_N_m3", "expected level_m or surface_m beside it");
  if (!section.has("unit_weight_N_m3") && !fill.surface.empty())
    section.refuse(has_surface ? "surface_m" : "level_m", "expected unit_weight_N_m3 beside it");
  for (std::size_t i = 0; i + 1 < fill.surface.size(); ++i)
    if (fill.surface[i + 1].x() <= fill.surface[i].x())
      section.refuse("surface_m", "expected points from left to right");
  section.refuse_unknown_keys();
}

}  // namespace voussoir
