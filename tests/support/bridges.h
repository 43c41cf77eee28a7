#pragma once
/// @file Bridges that tests share.

#include "core/structure/bridge_file.h"
#include "core/structure/model.h"

namespace voussoir::test {

inline std::filesystem::path example_bridge(const std::string& name) {
  return std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "examples" / "bridges" / (name + ".toml");
}

inline BridgeDescription small_description() {
  return read_bridge_file(example_bridge("small")).description;
}

/// Its joints filled with a weak lime mortar.
inline BridgeDescription small_description_with_mortar() {
  BridgeDescription description = small_description();
  description.joints.mortar = {.tensile_strength = 5e4,
                               .opening_energy = 10.0,
                               .cohesion = 1e5,
                               .slip_energy = 200.0,
                               .friction_angle = description.joints.friction_angle};
  return description;
}

/// On joints as stiff along as across and of little friction: without (5,3), or its mirror image (5,5), it
/// stands by what it has slid.
inline BridgeDescription sliding_description() {
  BridgeDescription description = small_description();
  description.joints.normal_stiffness = description.joints.tangential_stiffness = 3e7;
  description.joints.friction_angle = 0.45;
  return description;
}

/// On joints so soft that it settles by 0.19 m.
inline BridgeDescription soft_description() {
  BridgeDescription description = small_description();
  description.joints.normal_stiffness = 3e6;
  description.joints.tangential_stiffness = 3e5;
  return description;
}

inline Model small_bridge() {
  return make_model(small_description());
}

inline Model reference_bridge() {
  return make_model(reference_bridge_file().description);
}

/// What the bridge's control points read [m].
inline Eigen::VectorXd readings(const Model& bridge, const Field& field) {
  return vertical_displacements(field, bridge.control_points);
}

}  // namespace voussoir::test
