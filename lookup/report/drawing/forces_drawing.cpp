#include "lookup/report/drawing/forces_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/structure/block_boxes.h"
#include "core/units.h"
#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"

namespace voussoir {
namespace {

constexpr double kMegapascals = 1e-6;
constexpr double kHeadingShare = 0.125;  // of a flat bridge's height
constexpr double kLegendHeight = 34.0;
constexpr double kThickest = 7.0;  // units, of the joint with the highest pressure
constexpr double kThinnest = 1.2;

/// What both pictures begin with: the ground and the heading.
std::string background(const ForcesPicture& picture, const BridgeFrame& frame) {
  return ground_element(picture.layout, frame) +
         text_element({0.5 * frame.width, 17.0}, "middle", "strong", picture.heading);
}

BridgeFrame frame_of(const ForcesPicture& picture) {
  const double height = box_of(picture.layout.blocks).sizes().y();
  return frame_of(picture.layout, picture.width, std::min(kHeadingHeight, kHeadingShare * height), 0.15);
}

std::string missing_tip(const Block& block) {
  return fmt::format("({}) is missing", block.label);
}

/// One path for each colour level, of the triangles in it.
std::string triangles_by_level(const ForcesPicture& picture, const BridgeFrame& frame,
                               std::span<const TriangleStress> triangles, double highest) {
  std::array<std::string, kColourLevels> levels;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (std::isnan(triangles[t].tresca)) continue;
    Polygon corners;
    for (const NodeId node : picture.mesh.triangles[t].nodes)
      corners.emplace_back(picture.mesh.nodes.col(value(node)));
    levels.at(static_cast<std::size_t>(colour_level(triangles[t].tresca / highest))) +=
        closed_path(placed(corners, frame));
  }
  std::string elements;
  for (int level = 0; level < kColourLevels; ++level)
    elements += path_element(fmt::format("m{}", level), levels.at(static_cast<std::size_t>(level)));
  return elements;
}

double largest_in(const IndexRange& range, std::span<const TriangleStress> triangles) {
  double largest = 0.0;
  for (int t = range.begin; t < range.end; ++t)
    largest = std::max(largest, triangles[static_cast<std::size_t>(t)].tresca);
  return largest;
}

std::string_view css_class(JointCondition condition) {
  constexpr std::array<std::string_view, 3> kClasses = {"joint-open", "joint-sticking", "joint-sliding"};
  return kClasses.at(static_cast<std::size_t>(condition));
}

std::string joint_tip(const JointForces& joint) {
  return fmt::format(
      "{}\npressure {:.3g} and {:.3g} MPa at its ends\nnormal force {:.4g} kN, shear {:.4g} kN\n"
      "opening {:.3g} and {:.3g} mm\ntouching {:.0f} %, sliding {:.0f} % of its length",
      to_string(joint.condition), kMegapascals * joint.pressure[0], kMegapascals * joint.pressure[1],
      kKilonewtons * joint.normal, kKilonewtons * joint.shear, kMillimetres * std::max(0.0, joint.gap[0]),
      kMillimetres * std::max(0.0, joint.gap[1]), 100.0 * joint.closed_share, 100.0 * joint.sliding_share);
}

/// A line from end to end, as thick at each as the pressure there.
std::string joint_element(const JointForces& joint, const BridgeFrame& frame, double highest) {
  const Point from = frame(joint.ends[0]);
  const Point to = frame(joint.ends[1]);
  const Point along = (to - from).normalized();
  const Point across(-along.y(), along.x());
  const auto half = [&](double pressure) {
    return 0.5 * (kThinnest + (kThickest - kThinnest) * pressure / highest) * across;
  };
  const Point at_from = half(joint.pressure[0]);
  const Point at_to = half(joint.pressure[1]);
  const std::array<Point, 4> outline = {from + at_from, to + at_to, to - at_to, from - at_from};
  return path_element(css_class(joint.condition), closed_path(outline), joint_tip(joint));
}

std::string thrust_elements(std::span<const ThrustPoint> thrust, const BridgeFrame& frame) {
  std::map<int, std::vector<Point>> lines;
  for (const ThrustPoint& point : thrust)
    if (point.normal > 0.0) lines[point.ring].push_back(frame(point.at()));
  std::string elements;
  for (const auto& [ring, points] : lines)
    elements +=
        path_element("line thrust", open_path(points), fmt::format("thrust line of ring {}", ring + 1));
  return elements;
}

/// Of every ring, joint by joint as far as they follow each other.
std::string middle_thirds(std::span<const ThrustPoint> thrust, const BridgeFrame& frame) {
  std::string data;
  for (std::size_t i = 0; i + 1 < thrust.size(); ++i) {
    const ThrustPoint& a = thrust[i];
    const ThrustPoint& b = thrust[i + 1];
    if (a.ring != b.ring || a.second != b.first) continue;
    const auto edge = [&](const ThrustPoint& at, double side) {
      return frame(at.centre + side / 6.0 * at.thickness * at.outward);
    };
    const std::array<Point, 4> part = {edge(a, -1.0), edge(b, -1.0), edge(b, 1.0), edge(a, 1.0)};
    data += closed_path(part);
  }
  return data.empty() ? "" : path_element("band f3", data);
}

std::string legend_entry(double left, double y, std::string_view look, std::string_view text) {
  const std::array<Point, 2> stroke = {Point(left, y - 4.0), Point(left + 26.0, y - 4.0)};
  const std::array<Point, 4> bar = {stroke[0] + Point(0, 2.5), stroke[1] + Point(0, 2.5),
                                    stroke[1] - Point(0, 2.5), stroke[0] - Point(0, 2.5)};
  const bool is_line = look.starts_with("line");
  return path_element(look, is_line ? open_path(stroke) : closed_path(bar)) +
         text_element({left + 34.0, y}, "start", "", text);
}

std::string legend(double width, double y, double highest, bool has_thrust) {
  std::string elements = legend_entry(0.06 * width, y, "joint-sticking", "joint that sticks") +
                         legend_entry(0.22 * width, y, "joint-sliding", "slides") +
                         legend_entry(0.32 * width, y, "joint-open", "is open");
  if (has_thrust) elements += legend_entry(0.43 * width, y, "line thrust", "thrust line");
  return elements + text_element({0.97 * width, y}, "end", "small",
                                 fmt::format("thickest line: {:.3g} MPa", kMegapascals * highest));
}

}  // namespace

Drawing draw_stresses(const ForcesPicture& picture, std::span<const TriangleStress> triangles) {
  const BridgeFrame frame = frame_of(picture);
  const double height = frame.height + kColourBarHeight;
  const double highest = std::max(largest_in({0, static_cast<int>(triangles.size())}, triangles), 1e-300);
  std::string elements = background(picture, frame) + triangles_by_level(picture, frame, triangles, highest);
  elements += block_elements(picture.layout, frame, [&](BlockId id) {
    const Block& block = picture.layout.blocks[static_cast<std::size_t>(value(id))];
    if (picture.scene.lacks(id)) return BlockLook{"gone", missing_tip(block)};
    const double largest =
        largest_in(picture.mesh.block_triangles[static_cast<std::size_t>(value(id))], triangles);
    return BlockLook{
        "outline", fmt::format("({})\nTresca stress up to {:.3g} MPa", block.label, kMegapascals * largest)};
  });
  elements +=
      colour_bar({"Tresca stress [MPa]", round_marks(0.0, kMegapascals * highest)}, frame.width, height);
  return {frame.width, height, "Bridge, coloured by Tresca stress", elements};
}

Drawing draw_joints(const ForcesPicture& picture, std::span<const JointForces> joints,
                    std::span<const ThrustPoint> thrust) {
  const BridgeFrame frame = frame_of(picture);
  double highest = 1e-300;
  for (const JointForces& joint : joints) highest = std::max({highest, joint.pressure[0], joint.pressure[1]});
  std::string elements = background(picture, frame);
  elements += block_elements(picture.layout, frame, [&](BlockId id) {
    const Block& block = picture.layout.blocks[static_cast<std::size_t>(value(id))];
    return picture.scene.lacks(id) ? BlockLook{"gone", missing_tip(block)}
                                   : BlockLook{"stone", "(" + block.label + ")"};
  });
  for (const JointForces& joint : joints) elements += joint_element(joint, frame, highest);
  elements += thrust_elements(thrust, frame);
  elements += legend(frame.width, frame.height + 22.0, highest, !thrust.empty());
  return {frame.width, frame.height + kLegendHeight,
          "Bridge with its joints by pressure and contact, and thrust lines", elements};
}

Drawing draw_thrust(const ForcesPicture& picture, std::span<const ThrustPoint> thrust) {
  const BridgeFrame frame = frame_of(picture);
  std::string elements = background(picture, frame);
  elements += block_elements(picture.layout, frame, [&](BlockId id) {
    const Block& block = picture.layout.blocks[static_cast<std::size_t>(value(id))];
    if (picture.scene.lacks(id)) return BlockLook{"gone", missing_tip(block)};
    return BlockLook{block.role == BlockRole::ring ? "stone" : "outline", "(" + block.label + ")"};
  });
  elements += middle_thirds(thrust, frame) + thrust_elements(thrust, frame);
  const double y = frame.height + 22.0;
  elements += legend_entry(0.06 * frame.width, y, "line thrust", "thrust line") +
              legend_entry(0.22 * frame.width, y, "band f3",
                           "middle third: where the thrust line is inside, the whole joint is pressed");
  return {frame.width, frame.height + kLegendHeight, "Rings of the bridge with their thrust lines", elements};
}

}  // namespace voussoir
