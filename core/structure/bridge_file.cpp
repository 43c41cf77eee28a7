#include "core/structure/bridge_file.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <utility>

#include "core/structure/loads_section.h"
#include "core/structure/mortar_section.h"
#include "core/structure/movements_section.h"
#include "core/structure/uncertainty_section.h"
#include "reference_bridge_text.h"

namespace voussoir {
namespace {

constexpr std::uintmax_t kLargestFile = 1 << 20;  ///< [bytes] a bridge file is a page or two
constexpr std::size_t kLongestLine = 4096;        ///< [bytes] bounds how deep dotted keys nest
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kMostCourses = 1000;
constexpr int kMostVoussoirs = 1000;
constexpr double kMostBlocks = 20000;
constexpr double kMostPieces = 300000;  ///< blocks, each counted four times a level of refinement

void read_wall(TomlSection section, WallDescription& wall) {
  section.length("length_m", wall.length);
  section.count("courses", wall.courses, 0, kMostCourses);
  section.length("course_height_m", wall.course_height);
  section.length("block_length_m", wall.block_length);
  section.choice("bond", wall.bond, {{"running", Bond::running}, {"stack", Bond::stack}});
  section.positive("smallest_piece_m2", wall.smallest_piece);
  wall.smallest_block = kSmallestBlock;
  section.number("smallest_block", wall.smallest_block, 0.0, 0.5, true);
  section.flag("halved", wall.halved);
  section.refuse_unknown_keys();
}

SpanDescription read_span(TomlSection section) {
  SpanDescription span;
  section.number("centre_x_m", span.centre_x, -kLargestLength, kLargestLength, true);
  section.number("centre_y_m", span.centre_y, 0.0, kLargestLength, true);
  section.length("intrados_radius_m", span.intrados_radius);
  section.length("ring_thickness_m", span.ring_thickness);
  section.count("voussoirs", span.voussoirs, 3, kMostVoussoirs);
  section.refuse_unknown_keys();
  return span;
}

void read_material(TomlSection section, Material& material) {
  section.positive("young_modulus_Pa", material.young_modulus);
  section.number("poisson_ratio", material.poisson_ratio, 0.0, 0.49, true);
  section.positive("density_kg_m3", material.density);
  section.positive("thickness_m", material.thickness);
  section.choice("plane", material.plane, {{"stress", PlaneState::stress}, {"strain", PlaneState::strain}});
  section.number("thermal_expansion_per_K", material.thermal_expansion, 0.0, 1e-3, true);
  section.refuse_unknown_keys();
}

void read_joints(TomlSection section, BridgeDescription& description) {
  JointMaterial& joints = description.joints;
  section.positive("normal_stiffness_Pa_per_m", joints.normal_stiffness);
  section.positive("tangential_stiffness_Pa_per_m", joints.tangential_stiffness);
  double degrees = joints.friction_angle / kDegree;
  section.number("friction_angle_deg", degrees, 0.0, 89.0, true);
  joints.friction_angle = degrees * kDegree;
  section.number("tolerance_m", description.joint_tolerance, 0.0, 0.1, false);
  section.refuse_unknown_keys();
}

void read_supports(TomlSection section, SupportDescription& supports) {
  for (const auto& [key, target] : {std::pair{"base", &supports.base}, std::pair{"sides", &supports.sides},
                                    std::pair{"top", &supports.top}})
    section.choice(
        key, *target,
        {{"clamped", SupportKind::clamped}, {"roller", SupportKind::roller}, {"free", SupportKind::free}});
  section.count("embedded_courses", supports.embedded_courses, 0, kMostCourses);
  section.refuse_unknown_keys();
}

void read_control_points(TomlSection section, ControlPointDescription& points) {
  section.flag("top", points.top);
  section.flag("arch", points.arch);
  section.refuse_unknown_keys();
}

void read_mesh(TomlSection section, MeshDescription& mesh) {
  section.count("refinement", mesh.refinement, 0, 5);
  section.flag("split_at_corners", mesh.split_at_corners);
  section.refuse_unknown_keys();
}

/// The bridge must not have absurdly many blocks or triangles.
void check_size(const BridgeDescription& description, const std::string& file, long wall_line) {
  const WallDescription& wall = description.wall;
  double blocks = wall.courses * (wall.length / wall.block_length + 1.0);
  for (const SpanDescription& span : description.spans) blocks += span.voussoirs + 2;
  if (blocks > kMostBlocks)
    throw InputError(at_line(
        file, wall_line,
        fmt::format("the bridge would have {:.0f} blocks: expected at most {:.0f}", blocks, kMostBlocks)));
  if (blocks * std::pow(4.0, description.mesh.refinement) > kMostPieces)
    throw InputError(at_line(
        file, wall_line,
        fmt::format("{:.0f} blocks are too many for a refinement of {}: expected at most {:.0f}", blocks,
                    description.mesh.refinement, kMostPieces / std::pow(4.0, description.mesh.refinement))));
}

/// Spans must lie in the wall and beside each other.
void check_geometry(const BridgeDescription& description, const std::vector<long>& span_lines,
                    const std::string& file) {
  const WallDescription& wall = description.wall;
  for (std::size_t i = 0; i < description.spans.size(); ++i) {
    const SpanDescription& span = description.spans[i];
    const double left = span.centre_x - span.extrados_radius();
    const double right = span.centre_x + span.extrados_radius();
    if (left < -1e-9 || right > wall.length + 1e-9)
      throw InputError(
          at_line(file, span_lines[i],
                  fmt::format("the ring reaches from x = {:g} to {:g} m: expected it between 0 and the "
                              "wall's length {:g} m",
                              left, right, wall.length)));
    if (i > 0 && left < description.spans[i - 1].centre_x + description.spans[i - 1].extrados_radius() - 1e-9)
      throw InputError(
          at_line(file, span_lines[i],
                  "the ring overlaps the one before: expected spans from left to right, side by side"));
  }
}

/// From where to where there can be blocks.
Interval extent_along_x(const BridgeDescription& description) {
  if (description.wall.courses > 0 || description.spans.empty()) return {0.0, description.wall.length};
  const SpanDescription& first = description.spans.front();
  const SpanDescription& last = description.spans.back();
  return {first.centre_x - first.extrados_radius(), last.centre_x + last.extrados_radius()};
}

/// The parser keeps the depth of values within bounds, but not that of keys a.b.c.
void check_lines(std::string_view text, const std::string& file) {
  long line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (end - start > kLongestLine)
      throw InputError(at_line(
          file, line, fmt::format("a line of {} bytes: expected at most {}", end - start, kLongestLine)));
    start = end + 1;
  }
}

BridgeDescription interpret(const toml::table& root, const std::string& file) {
  BridgeDescription description;
  TomlSection top(file, &root, "");
  const auto section = [&](const char* key) {
    return TomlSection(file, top.table(key), fmt::format(" in [{}]", key));
  };
  top.text("name", description.name);
  top.not_negative("gravity_m_s2", description.gravity);
  read_wall(section("wall"), description.wall);
  read_material(section("material"), description.material);
  read_joints(section("joints"), description);
  read_supports(section("supports"), description.supports);
  read_control_points(section("control_points"), description.control_points);
  read_mesh(section("mesh"), description.mesh);
  description.uncertainty = read_uncertainty(section("uncertainty"));

  std::vector<long> span_lines(description.spans.size(), 0);
  if (const toml::array* spans = top.tables("spans", "[[spans]]")) {
    description.spans.clear();
    span_lines.clear();
    for (const toml::node& node : *spans) {
      description.spans.push_back(read_span(TomlSection(file, node.as_table(), " in [[spans]]")));
      span_lines.push_back(static_cast<long>(node.source().begin.line));
    }
  }
  if (const toml::array* mortar = top.tables("mortar", "[[mortar]]"))
    description.mortar = read_mortar(*mortar, file, description);
  if (const toml::array* movements = top.tables("movements", "[[movements]]"))
    description.movements = read_movements(*movements, file);
  const toml::array* loads = top.tables("loads", "[[loads]]");
  top.refuse_unknown_keys();
  check_size(description, file, top.line_of("wall"));
  check_geometry(description, span_lines, file);
  if (loads != nullptr) description.loads = read_loads(*loads, file, extent_along_x(description));
  return description;
}

}  // namespace

BridgeFile parse_bridge_file(std::string_view text, const std::string& name) {
  check_lines(text, name);
  try {
    const toml::table root = toml::parse(text, name);
    return {name, std::string(text), interpret(root, name)};
  } catch (const toml::parse_error& error) {
    throw InputError(at_line(name, error.source().begin.line, std::string(error.description())));
  }
}

BridgeFile read_bridge_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw InputError(fmt::format("{}: cannot be opened: expected a bridge file (TOML)", path.string()));
  std::string text(kLargestFile + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLargestFile)
    throw InputError(
        fmt::format("{}: larger than {} bytes: expected a bridge file (TOML)", path.string(), kLargestFile));
  return parse_bridge_file(text, path.string());
}

BridgeFile reference_bridge_file() {
  return parse_bridge_file(kReferenceBridgeText, "reference.toml");
}

}  // namespace voussoir
