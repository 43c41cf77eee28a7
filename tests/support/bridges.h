#pragma once
/// @file Bridges that tests share.

#include "core/bridge_file/bridge_file.h"
#include "core/structure/model.h"

namespace voussoir::test {

inline std::filesystem::path example_bridge(const std::string& name) {
  return std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "examples" / "bridges" / (name + ".toml");
}

inline BridgeDescription small_description() {
  return read_bridge_file(example_bridge("small")).description;
}

/// Sensors of every quantity, one of them over a joint.
inline constexpr char kSmallSensors[] = R"(
[[sensors]]
name = "V1"
x_m = 1.5
y_m = 2.5
block = "5,3"
[[sensors]]
name = "H1"
quantity = "ux"
x_m = 0.75
y_m = 1.8
[[sensors]]
name = "N1"
quantity = "tilt"
block = "4,2"
[[sensors]]
name = "G1"
quantity = "distance"
x_m = 0.25
y_m = 0.75
x2_m = 0.25
y2_m = 1.25
)";

inline BridgeFile small_file_with_sensors() {
  return parse_bridge_file(read_bridge_file(example_bridge("small")).text + kSmallSensors, "small");
}

/// Of all its points.
inline std::size_t weight_count(const Structure& bridge) {
  std::size_t count = 0;
  for (const ControlPoint& point : bridge.control_points) count += point.weights.size();
  return count;
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

/// A random one (tools/benchmark bridges, seed 3600): intact, it stands only by what it has slid.
inline constexpr char kSlidBridge[] = R"(name = "slid"
[wall]
length_m = 6.462595373147162
courses = 10
course_height_m = 0.47528522660557576
block_length_m = 1.4521562689005196
bond = "stack"
[[spans]]
centre_x_m = 3.2312976865735816
centre_y_m = 1.0509631945006541
intrados_radius_m = 1.6297080835471154
ring_thickness_m = 0.17854444326507057
voussoirs = 26
[material]
young_modulus_Pa = 52514082838.163956
[joints]
normal_stiffness_Pa_per_m = 627944553.1411244
tangential_stiffness_Pa_per_m = 915250188.8370724
friction_angle_deg = 38.51903700870821
)";

inline BridgeDescription slid_description() {
  return parse_bridge_file(kSlidBridge, "slid").description;
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
  return readings_at(bridge.control_points, field);
}

}  // namespace voussoir::test
