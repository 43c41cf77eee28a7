#include "tools/validation/assemblies.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "core/statics/joint_forces.h"

namespace voussoir::validation {

Model assemble_blocks(const BridgeDescription& description, const std::vector<Polygon>& polygons) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    Block& block = blocks.emplace_back();
    block.label = fmt::format("{}", i + 1);
    block.kind = BlockKind::plain;
    block.polygon = polygons[i];
  }
  Structure structure = assemble(std::move(blocks), {.mesh = description.mesh,
                                                     .joint_tolerance = description.joint_tolerance,
                                                     .mirror_axis = 0.5 * description.wall.length});
  structure.symmetry.reset();
  structure.supports = box_supports(structure.mesh, description.supports, description.wall.length);
  return with_nominal_parameters(std::move(structure), description);
}

void disturb_inner_nodes(double spacing, double share, Model& bridge) {
  std::vector<bool> inside(static_cast<std::size_t>(bridge.mesh.node_count()), true);
  for (const BoundaryEdge& edge : bridge.mesh.edges)
    inside[static_cast<std::size_t>(value(edge.from))] = false;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> way(-share * spacing, share * spacing);
  for (int node = 0; node < bridge.mesh.node_count(); ++node)
    if (inside[static_cast<std::size_t>(node)])
      bridge.mesh.nodes.col(node) += Point(way(random), way(random));
}

Polygon rectangle(const Point& corner, double width, double height) {
  return {corner, corner + Point(width, 0.0), corner + Point(width, height), corner + Point(0.0, height)};
}

Polygon strip(double length, double depth, int parts) {
  Polygon polygon;
  for (int i = 0; i <= parts; ++i) polygon.emplace_back(length * i / parts, 0.0);
  for (int i = parts; i >= 0; --i) polygon.emplace_back(length * i / parts, depth);
  return polygon;
}

Polygon turned(const Polygon& polygon, double angle, const Point& shift) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Polygon result;
  for (const Point& corner : polygon) result.push_back(turn * corner + shift);
  return result;
}

Model block_on_wedge(double slope, double friction_angle, double size) {
  const double length = 6.0 * size;
  const Point along(-std::cos(slope), std::sin(slope));
  const Point up(std::sin(slope), std::cos(slope));
  const Point foot(length, 0.0);
  const Point corner = foot + 4.0 * size * along;
  BridgeDescription description;
  description.wall.length = length;
  description.joints.friction_angle = friction_angle;
  description.joint_tolerance *= size;
  description.supports.sides = SupportKind::free;
  return assemble_blocks(description, {{Point(0.0, 0.0), foot, Point(0.0, length * std::tan(slope))},
                                       {corner, corner + 0.5 * size * up, corner + size * (along + 0.5 * up),
                                        corner + size * along}});
}

Model floating_course(int blocks, double friction_angle) {
  BridgeDescription description;
  description.wall = {.length = static_cast<double>(blocks), .courses = 1, .bond = Bond::stack};
  description.spans.clear();
  description.supports = {.base = SupportKind::free, .sides = SupportKind::free};
  description.joints.friction_angle = friction_angle;
  description.gravity = 0.0;
  return make_model(description);
}

Model column(int courses, double young_modulus) {
  BridgeDescription description;
  description.spans.clear();
  description.wall = {
      .length = 1.0, .courses = courses, .course_height = 0.5, .block_length = 1.0, .bond = Bond::stack};
  description.supports.sides = SupportKind::free;
  description.control_points.arch = false;
  description.material.young_modulus = young_modulus;
  return make_model(description);
}

BridgeDescription arch_description(double normal_stiffness, double friction) {
  BridgeDescription description;
  description.wall = {.length = 2.0 * kArchCentre, .courses = 0};
  description.supports.sides = SupportKind::free;
  description.material.young_modulus = 100.0 * normal_stiffness;
  description.joints = {.normal_stiffness = normal_stiffness,
                        .tangential_stiffness = normal_stiffness,
                        .friction_angle = std::atan(friction)};
  description.mesh.split_at_corners = false;
  return description;
}

Model semicircular_ring(int voussoirs, double thickness, double friction, double normal_stiffness) {
  const double inner = 1.0 - 0.5 * thickness;
  const double outer = 1.0 + 0.5 * thickness;
  const int chords = 32 / voussoirs + 1;
  const auto at = [&](double radius, int j, int chord) {
    const double angle = std::numbers::pi * (j + static_cast<double>(chord) / chords) / voussoirs;
    return Point(kArchCentre - radius * std::cos(angle), kFooting + radius * std::sin(angle));
  };
  std::vector<Polygon> blocks = {rectangle({kArchCentre - outer, 0.0}, thickness, kFooting),
                                 rectangle({kArchCentre + inner, 0.0}, thickness, kFooting)};
  for (int j = 0; j < voussoirs; ++j) {
    Polygon& block = blocks.emplace_back();
    for (int i = 0; i <= chords; ++i) block.push_back(at(inner, j, i));
    for (int i = chords; i >= 0; --i) block.push_back(at(outer, j, i));
  }
  return assemble_blocks(arch_description(normal_stiffness, friction), blocks);
}

Field boundary_tractions(const Model& bridge, const Eigen::Vector3d& stress) {
  Field forces = Field::Zero(2, bridge.mesh.node_count());
  for (const BoundaryEdge& edge : bridge.mesh.edges) {
    const Point along = bridge.mesh.position(edge.to) - bridge.mesh.position(edge.from);
    const Point normal(along.y(), -along.x());  // times the length
    const Point half = 0.5 * bridge.parameters.blocks.front().thickness *
                       Point(stress[0] * normal.x() + stress[2] * normal.y(),
                             stress[2] * normal.x() + stress[1] * normal.y());
    forces.col(value(edge.from)) += half;
    forces.col(value(edge.to)) += half;
  }
  return forces;
}

Point joint_force(const Model& bridge, const Field& displacement, BlockId first, BlockId second) {
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  const StageEquations equations(system, coefficients, {});
  Point force = Point::Zero();
  for (const JointForces& found : joint_forces(equations, bridge.parameters, displacement)) {
    const Joint& joint = bridge.joints[found.joint];
    const Point on_second = found.on_second[0] + found.on_second[1];
    if (joint.first == first && joint.second == second) force += on_second;
    if (joint.first == second && joint.second == first) force -= on_second;
  }
  return force;
}

}  // namespace voussoir::validation
