#include "core/bridge_file/bridge_file.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/bridge_file/blocks_section.h"
#include "core/bridge_file/loads_section.h"
#include "core/bridge_file/materials_section.h"
#include "core/bridge_file/mortar_section.h"
#include "core/bridge_file/movements_section.h"
#include "core/bridge_file/parts_section.h"
#include "core/bridge_file/sensors_section.h"
#include "core/bridge_file/spans_section.h"
#include "core/bridge_file/uncertainty_section.h"
#include "core/bridge_file/usual_values.h"
#include "core/geometry/box.h"
#include "core/structure/arch.h"
#include "core/structure/block_limits.h"
#include "core/text_file.h"
#include "reference_bridge_text.h"

namespace voussoir {
namespace {

constexpr std::uintmax_t kLongestText = 1 << 20;  ///< [bytes] a bridge file is a page or two
constexpr std::size_t kLongestLine = 4096;        ///< [bytes] bounds how deep dotted keys nest
constexpr std::size_t kLongestName = 200;         ///< [bytes] of a bridge, a title and a file's attribute
constexpr double kMostPieces = 300000;            ///< blocks, each counted four times a level of refinement

void read_supports(TomlSection section, SupportDescription& supports) {
  for (const auto& [key, target] : {std::pair{"base", &supports.base}, std::pair{"sides", &supports.sides},
                                    std::pair{"top", &supports.top}})
    section.choice(
        key, *target,
        {{"clamped", SupportKind::clamped}, {"roller", SupportKind::roller}, {"free", SupportKind::free}});
  section.count("embedded_courses", supports.embedded_courses, 0, kMostCourses);
  section.refuse_unknown_keys();
}

/// Only a wall has a top, and only what is laid has courses.
void check_held_courses(const TomlSection& section, const BridgeDescription& description) {
  const SupportDescription& held = description.supports;
  const bool is_given = !description.blocks.empty();
  if (held.top != SupportKind::free && (is_given || description.wall.courses == 0))
    section.refuse("top", is_given
                              ? "is held: expected free: blocks that are given one by one have no top course"
                              : "is held: expected courses in [wall], whose top it is");
  if (held.embedded_courses > 0 && is_given)
    section.refuse("embedded_courses",
                   fmt::format("is {}: expected 0: blocks that are given one by one lie in no courses",
                               held.embedded_courses));
}

void read_control_points(TomlSection section, ControlPointDescription& points) {
  section.flag("top", points.top);
  section.flag("arch", points.arch);
  section.flag("face", points.face);
  section.refuse_unknown_keys();
}

void read_mesh(TomlSection section, MeshDescription& mesh) {
  section.count("refinement", mesh.refinement, 0, 5);
  section.flag("split_at_corners", mesh.split_at_corners);
  section.refuse_unknown_keys();
}

/// The bridge must not have absurdly many blocks or triangles.
void check_size(const BridgeDescription& description, const std::string& file, long wall_line) {
  const auto laid = [](const WallDescription& courses) {
    return courses.courses * (courses.length / courses.block_length + 1.0) * (courses.halved ? 2.0 : 1.0);
  };
  double blocks = static_cast<double>(description.blocks.size()) + laid(description.wall);
  for (const WallPart& part : description.parts) blocks += laid(part.courses);
  for (const SpanDescription& span : description.spans) {
    blocks += span.voussoirs + 2;
    for (const RingDescription& ring : span.outer_rings) blocks += ring.voussoirs + 1;
  }
  if (blocks > static_cast<double>(kMostBlocks))
    throw InputError(at_line(
        file, wall_line,
        fmt::format("the bridge would have {:.0f} blocks: expected at most {}", blocks, kMostBlocks)));
  if (blocks * std::pow(4.0, description.mesh.refinement) > kMostPieces)
    throw InputError(at_line(
        file, wall_line,
        fmt::format("{:.0f} blocks are too many for a refinement of {}: expected at most {:.0f}", blocks,
                    description.mesh.refinement, kMostPieces / std::pow(4.0, description.mesh.refinement))));
}

/// From where to where an arch reaches. Throws InputError if its rings cannot be built.
Interval extent_of(const SpanDescription& span, const WallDescription& wall) {
  if (span.shape == IntradosShape::semicircular && span.outer_rings.empty())
    return {span.centre_x - span.extrados_radius(), span.centre_x + span.extrados_radius()};
  const Arch arch = make_arch(span, wall.courses > 0);
  const Box box = box_of(arch.enclosed);
  return {box.min().x(), box.max().x()};
}

/// Spans must lie in the wall and beside each other.
void check_geometry(const BridgeDescription& description, const std::vector<long>& span_lines,
                    const std::string& file) {
  const WallDescription& wall = description.wall;
  double end_of_last = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < description.spans.size(); ++i) {
    const auto refuse = [&](const std::string& message) {
      throw InputError(at_line(file, span_lines[i], message));
    };
    Interval extent{};
    try {
      extent = extent_of(description.spans[i], wall);
    } catch (const InputError& error) {
      refuse(error.what());
    }
    if (extent.left < -1e-9 || extent.right > wall.length + 1e-9)
      refuse(
          fmt::format("the ring reaches from x = {:g} to {:g} m: expected it between 0 and the wall's length "
                      "{:g} m",
                      extent.left, extent.right, wall.length));
    if (extent.left < end_of_last - 1e-9)
      refuse("the ring overlaps the one before: expected spans from left to right, side by side");
    end_of_last = extent.right;
  }
  for (const WallPart& part : description.parts)
    if (part.from_x + part.courses.length > wall.length + 1e-9)
      throw InputError(
          fmt::format("{}: a part in [[walls]] reaches from x = {:g} to {:g} m: expected it between "
                      "0 and length_m in [wall], {:g} m",
                      file, part.from_x, part.from_x + part.courses.length, wall.length));
}

/// From where to where there can be blocks.
Interval extent_along_x(const BridgeDescription& description) {
  if (!description.blocks.empty()) {
    const Bounds bounds = bounds_of(description);
    return {bounds.corner.x(), bounds.corner.x() + bounds.length};
  }
  const bool rings_only = description.wall.courses == 0 && description.parts.empty();
  if (!rings_only || description.spans.empty()) return {0.0, description.wall.length};
  return {extent_of(description.spans.front(), description.wall).left,
          extent_of(description.spans.back(), description.wall).right};
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

/// [[spans]] and [[walls]]. Returns the line of each span.
std::vector<long> read_spans_and_walls(TomlSection& top, BridgeDescription& description) {
  std::vector<long> span_lines(description.spans.size(), 0);
  if (const toml::array* spans = top.tables("spans", "[[spans]]")) {
    description.spans.clear();
    span_lines.clear();
    for (const toml::node& node : *spans) {
      description.spans.push_back(read_span(TomlSection(top.file(), node.as_table(), " in [[spans]]")));
      span_lines.push_back(static_cast<long>(node.source().begin.line));
    }
  }
  if (const toml::array* walls = top.tables("walls", "[[walls]]"))
    for (const toml::node& node : *walls)
      description.parts.push_back(
          read_part(TomlSection(top.file(), node.as_table(), " in [[walls]]"), description.wall));
  return span_lines;
}

/// [[regions]], which take from the bridge's material and joints what they do not say.
void read_regions(TomlSection& top, BridgeDescription& description) {
  if (const toml::array* regions = top.tables("regions", "[[regions]]"))
    for (const toml::node& node : *regions)
      description.regions.push_back(read_region(TomlSection(top.file(), node.as_table(), " in [[regions]]"),
                                                description.material, description.joints));
}

void read_name(TomlSection& top, std::string& name) {
  top.text("name", name);
  if (name.size() > kLongestName)
    top.refuse("name", fmt::format("has {} bytes: expected at most {}", name.size(), kLongestName));
}

BridgeDescription interpret(const toml::table& root, const std::string& file,
                            std::vector<std::string>& notes) {
  BridgeDescription description;
  std::ranges::move(unusual_values(root), std::back_inserter(notes));
  TomlSection top(file, &root, "");
  const auto section = [&](const char* key) {
    return TomlSection(file, top.table(key), fmt::format(" in [{}]", key));
  };
  read_name(top, description.name);
  description.collapse_fields = false;
  top.choice("collapses", description.collapse_fields, {{"outcome", false}, {"field", true}});
  top.not_negative("gravity_m_s2", description.gravity);
  read_wall(section("wall"), description.wall);
  read_material(section("material"), description.material);
  read_joints(section("joints"), description.joints, description.joint_tolerance);
  read_regions(top, description);
  read_fill(section("fill"), description.fill);
  read_supports(section("supports"), description.supports);
  read_control_points(section("control_points"), description.control_points);
  if (const toml::array* sensors = top.tables("sensors", "[[sensors]]"))
    description.sensors = read_sensors(*sensors, file);
  read_mesh(section("mesh"), description.mesh);
  description.uncertainty = read_uncertainty(section("uncertainty"));

  const std::vector<long> span_lines = read_spans_and_walls(top, description);
  if (top.has("blocks")) std::ranges::move(read_blocks(top, description), std::back_inserter(notes));
  description.missing_blocks = top.texts("missing_blocks");
  check_held_courses(section("supports"), description);
  top.know("blocks_tolerance_m");
  if (const toml::array* mortar = top.tables("mortar", "[[mortar]]"))
    description.mortar = read_mortar(*mortar, file, description);
  if (const toml::array* movements = top.tables("movements", "[[movements]]"))
    description.movements = read_movements(*movements, file);
  const toml::array* loads = top.tables("loads", "[[loads]]");
  top.refuse_unknown_keys();
  check_size(description, file, top.line_of(description.blocks.empty() ? "wall" : "blocks"));
  check_geometry(description, span_lines, file);
  if (loads != nullptr) description.loads = read_loads(*loads, file, extent_along_x(description));
  return description;
}

}  // namespace

BridgeFile parse_bridge_file(std::string_view text, const std::string& name) {
  check_lines(text, name);
  try {
    const toml::table root = toml::parse(text, name);
    BridgeFile bridge{name, std::string(text), {}, {}};
    bridge.description = interpret(root, name, bridge.notes);
    return bridge;
  } catch (const toml::parse_error& error) {
    throw InputError(at_line(name, error.source().begin.line, std::string(error.description())));
  }
}

BridgeFile read_bridge_file(const std::filesystem::path& path) {
  const std::string text = read_text(path, kLongestText, "a bridge file (TOML)");
  check_lines(text, path.string());
  WithBlocks whole = with_blocks_of_file(text, path);
  BridgeFile bridge{path.string(), std::move(whole.text), {}, std::move(whole.notes)};
  bridge.description = interpret(whole.root, bridge.name, bridge.notes);
  return bridge;
}

BridgeFile reference_bridge_file() {
  return parse_bridge_file(kReferenceBridgeText, "reference.toml");
}

}  // namespace voussoir
