#include "generator/scenes/results_key.h"

#include <fmt/format.h>

#include "database/format/sha256.h"

namespace voussoir {
namespace {

/// Numbers by their bits, so that no two values look alike. The structured bindings below fail to compile
/// when a description gains a member, which then has to be added here.
template <class... Numbers>
std::string row(const char* name, const Numbers&... numbers) {
  std::string text = name;
  ((text += fmt::format(" {:a}", static_cast<double>(numbers))), ...);
  return text + "\n";
}

std::string wall_text(const WallDescription& wall) {
  const auto& [length, courses, course_height, block_length, bond, smallest_piece, smallest_block, halved] =
      wall;
  return row("wall", length, courses, course_height, block_length, bond, smallest_piece, smallest_block) +
         (halved ? "halved\n" : "");
}

std::string span_text(const SpanDescription& span) {
  const auto& [centre_x, centre_y, intrados_radius, ring_thickness, voussoirs, shape, clear_span, rise,
               arc_radius, points, staggered, outer_rings, skewback] = span;
  std::string text = row("span", centre_x, centre_y, intrados_radius, ring_thickness, voussoirs, shape,
                         clear_span, rise, arc_radius, staggered, skewback.value_or(-1.0));
  for (const Point& point : points) text += row("point", point.x(), point.y());
  for (const RingDescription& ring : outer_rings) {
    const auto& [thickness, ring_voussoirs, ring_staggered] = ring;
    text += row("ring", thickness, ring_voussoirs, ring_staggered);
  }
  return text;
}

std::string part_text(const WallPart& part) {
  const auto& [role, from_x, base_y, courses] = part;
  return row("part", role, from_x, base_y) + wall_text(courses);
}

std::string material_text(const Material& material) {
  const auto& [young_modulus, poisson_ratio, density, thickness, plane, thermal_expansion] = material;
  return row("material", young_modulus, poisson_ratio, density, thickness, plane,
             thermal_expansion);  // bridges are cooled and warmed to see whether they settle
}

/// Nothing for dry joints.
std::string mortar_text(const Mortar& mortar) {
  const auto& [tensile_strength, opening_energy, cohesion, slip_energy, friction_angle, compressive_strength,
               crushing_energy] = mortar;
  if (!mortar.is_there()) return "";
  return row("mortar", tensile_strength, opening_energy, cohesion, slip_energy, friction_angle,
             compressive_strength, crushing_energy);
}

std::string joint_text(const JointMaterial& joints) {
  const auto& [normal_stiffness, tangential_stiffness, friction_angle, mortar] = joints;
  return row("joints", normal_stiffness, tangential_stiffness, friction_angle) + mortar_text(mortar);
}

std::string region_text(const MortarRegion& region) {
  const auto& [mortar, normal_stiffness, tangential_stiffness, within_blocks, between] = region;
  return row("region", normal_stiffness.value_or(0.0), tangential_stiffness.value_or(0.0), within_blocks) +
         fmt::format("{}\n", fmt::join(between, " | ")) + mortar_text(mortar);
}

std::string block_text(const Block& block) {
  std::string text = row(block.label.c_str(), block.role, block.ring);
  for (const Point& corner : block.polygon) text += row("corner", corner.x(), corner.y());
  return text;
}

std::string region_text(const Region& region) {
  const auto& [of, material, joints] = region;
  std::string text = "region";
  for (const std::string& name : of) text += " " + name;
  return text + "\n" + material_text(material) + joint_text(joints);
}

std::string mesh_text(const MeshDescription& mesh) {
  const auto& [refinement, split_at_corners] = mesh;
  return row("mesh", refinement, split_at_corners);
}

std::string support_text(const SupportDescription& supports) {
  const auto& [base, sides, top, embedded_courses] = supports;
  const bool held_above = top != SupportKind::free || embedded_courses > 0;
  return row("supports", base, sides) + (held_above ? row("held", top, embedded_courses) : "");
}

std::string points_text(const ControlPointDescription& points) {
  const auto& [top, arch, face] = points;
  return row("points", top, arch) + (face ? "face\n" : "");
}

/// Texts in quotes and numbers by their bits; a place that is missing is none.
std::string sensor_text(const SensorDescription& sensor) {
  const auto& [name, quantity, from, to, block, to_block] = sensor;
  std::string text = fmt::format("sensor {} '{}' '{}'\n", name, block, to_block) + row("reads", quantity);
  if (from) text += row("from", from->x(), from->y());
  if (to) text += row("to", to->x(), to->y());
  return text;
}

std::string physics_text(const BridgeDescription& description) {
  const auto& [name, wall, spans, parts, blocks, missing_blocks, material, joints, mortar, regions, fill,
               supports, control_points, sensors, mesh, gravity, joint_tolerance, loads, movements,
               uncertainty, collapse_fields] = description;
  static_cast<void>(movements);        // no scene is solved under them
  static_cast<void>(uncertainty);      // no solution depends on it
  static_cast<void>(collapse_fields);  // stands among the settings
  static_cast<void>(loads);            // whose states are told apart by load case
  static_cast<void>(control_points);   // points_key
  static_cast<void>(sensors);
  static_cast<void>(name);
  std::string text = wall_text(wall);
  for (const SpanDescription& span : spans) text += span_text(span);
  for (const MortarRegion& region : mortar) text += region_text(region);
  for (const WallPart& part : parts) text += part_text(part);
  for (const Block& block : blocks) text += block_text(block);
  for (const std::string& label : missing_blocks) text += fmt::format("missing {}\n", label);
  for (const Region& region : regions) text += region_text(region);
  text += row("fill", fill.unit_weight);
  for (const Point& point : fill.surface) text += row("surface", point.x(), point.y());
  return text + material_text(material) + joint_text(joints) + support_text(supports) + mesh_text(mesh) +
         row("load", gravity) + row("tolerance", joint_tolerance);
}

}  // namespace

std::string points_key(const BridgeDescription& description) {
  std::string text = points_text(description.control_points);
  for (const SensorDescription& sensor : description.sensors) text += sensor_text(sensor);
  return to_hexadecimal(sha256(text));
}

std::string results_key(const BridgeDescription& description, const Provenance& made) {
  return to_hexadecimal(
      sha256(fmt::format("{}\n{}\n{}\n{}\n{}", physics_text(description), made.solver_settings,
                         made.solver_revision, made.compiler, made.compile_flags)));
}

}  // namespace voussoir
