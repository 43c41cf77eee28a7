#include "generator/bridge_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>

#include "core/error.h"
#include "core/structure/top_surface.h"
#include "core/text.h"
#include "core/units.h"
#include "generator/load_drawing.h"

namespace voussoir {
namespace {

constexpr double kLeastWidth = 1200.0;  ///< [px] of the picture; wider where labels need it
constexpr double kMostWidth = 4800.0;
constexpr double kMargin = 50.0;           ///< [px] on all sides, with the scale
constexpr double kLabelHeight = 9.0;       ///< [px]
constexpr double kSmallLabel = 2.0 / 3.0;  ///< [-] of the others' size, as in the style

constexpr const char* kLightColours =
    "--page:#fff;--text:#222;--edge:#666;--joint:#000;--sensor:#c00;--held:#06c;--load:#b00;--soil:#e9e2d2;"
    "--wall:#e4d9c4;--ring:#d6a77a;--pier:#cbbfa6;--abutment:#bfb49c;--parapet:#efe7d6;--backing:#c9c9c0;"
    "--fill:#d9cdb0";
constexpr const char* kDarkColours =
    "--page:#14171b;--text:#e6e8eb;--edge:#8b8f96;--joint:#d0d4d8;--sensor:#ff8a7a;--held:#6ab4ff;--load:#"
    "ff9a57;"
    "--soil:#2a2822;--wall:#3f3a30;--ring:#75512f;--pier:#4d4636;--abutment:#55503f;--parapet:#34312a;"
    "--backing:#41433f;--fill:#4a4332";
constexpr const char* kStyle =
    "svg{color-scheme:light dark}"
    "text{font:9px system-ui,\"DejaVu Sans\",sans-serif;fill:var(--text);text-anchor:middle}"
    ".big{font-size:13px}.small{font-size:6px}.key{font-size:11px}.start{text-anchor:start}"
    ".name{font-weight:600;paint-order:stroke;stroke:var(--page);stroke-width:2.5px}"
    ".swatch{stroke:var(--edge);stroke-width:.5}\n"
    "path{stroke:var(--edge);stroke-width:.5}.page{fill:var(--page)}.wall{fill:var(--wall)}.ring{fill:var(--"
    "ring)}"
    ".pier{fill:var(--pier)}.abutment{fill:var(--abutment)}.parapet{fill:var(--parapet)}"
    ".backing{fill:var(--backing)}.fill{fill:var(--fill);fill-opacity:.6}\n"
    ".soil{fill:var(--soil);stroke:none}.gauge{stroke:var(--sensor);stroke-width:1}"
    ".joint{stroke:var(--joint);stroke-width:1}.support{fill:none;stroke:var(--held);stroke-width:1.5}"
    ".roller{fill:var(--page);stroke:var(--held)}.point{fill:var(--sensor)}.held{fill:var(--held)}"
    ".load{stroke:var(--load);stroke-width:2;fill:none}.loads{fill:var(--load)}\n";

using Soil = std::array<Point, 4>;  ///< a piece of what only weighs [m]

/// [px] that a label is wide.
double label_width(const Block& block) {
  return 0.6 * kLabelHeight * static_cast<double>(block.label.size());
}

/// [px] so that all but the smallest tenth of the blocks have room for their labels, if that is no more than
/// a picture may be wide.
double width_for_labels(const BlockLayout& layout, double length) {
  std::vector<double> scales;
  for (const Block& block : layout.blocks)
    scales.push_back(label_width(block) / std::sqrt(area(block.polygon)));
  const auto most = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() * 9 / 10);
  std::ranges::nth_element(scales, most);
  return std::clamp(*most * length + 2.0 * kMargin, kLeastWidth, kMostWidth);
}

/// From places on the bridge to the picture.
struct Frame {
  Point low, high;
  double width, scale;
  double above;  ///< [px] the bridge

  Frame(const Structure& bridge, const std::vector<Soil>& soil, std::size_t load_cases)
      : low(bridge.mesh.nodes.rowwise().minCoeff()),
        high(bridge.mesh.nodes.rowwise().maxCoeff()),
        width(width_for_labels(bridge.layout, high.x() - low.x())),
        scale((width - 2.0 * kMargin) / (high.x() - low.x())),
        above(1.8 * kMargin + kLoadRow * static_cast<double>(load_cases)) {
    for (const Soil& piece : soil)
      for (const Point& corner : piece) high = high.cwiseMax(corner);
  }
  Point operator()(const Point& p) const {
    return {kMargin + scale * (p.x() - low.x()), above + scale * (high.y() - p.y())};
  }
  double height() const { return above + 1.5 * kMargin + scale * (high.y() - low.y()); }
};

/// A closed outline, as a path's data.
std::string outline(std::span<const Point> corners, const Frame& frame) {
  std::string data;
  for (const Point& corner : corners) {
    const Point p = frame(corner);
    fmt::format_to(std::back_inserter(data), "{}{:.1f} {:.1f}", data.empty() ? 'M' : 'L', p.x(), p.y());
  }
  return data + 'Z';
}

std::string blocks(const BlockLayout& layout, const Frame& frame) {
  std::string elements;
  for (const Block& block : layout.blocks)
    elements += fmt::format("<path class=\"{0}\" d=\"{1}\"><title>{2} {0}, {3:.3f} m2</title></path>\n",
                            name_of(block.role), outline(block.polygon, frame), escaped(block.label),
                            area(block.polygon));
  return elements;
}

std::string soil(const std::vector<Soil>& pieces, double unit_weight, const Frame& frame) {
  std::string data;
  for (const Soil& piece : pieces) data += outline(piece, frame);
  if (data.empty()) return "";
  return fmt::format(
      "<path class=\"soil\" d=\"{}\"><title>soil that only weighs, {:g} kN/m3</title></path>\n", data,
      kKilonewtons * unit_weight);
}

/// Labels of the blocks in which they have room, small ones where that helps, above a sensor in their place.
std::string labels(const Structure& bridge, const Frame& frame) {
  std::string elements;
  for (const Block& block : bridge.layout.blocks) {
    const double width = label_width(block);
    const double room = frame.scale * std::sqrt(area(block.polygon)) / width;
    if (room < kSmallLabel) continue;
    const Point middle = frame(centroid(block.polygon));
    const bool is_taken = std::ranges::any_of(bridge.control_points, [&](const ControlPoint& point) {
      const Point away = (frame(point.position) - middle).cwiseAbs();
      return away.x() < 0.5 * width + 2.0 && away.y() < 0.5 * kLabelHeight + 2.0;
    });
    elements += text_at(middle + Point(0.0, is_taken ? -5.0 : 3.0), room < 1.0 ? "small" : "", block.label);
  }
  return elements;
}

std::string joints(const Structure& bridge, const Frame& frame) {
  std::string data;
  for (const Joint& joint : bridge.joints) {
    const auto ends = ends_of(joint, bridge.mesh);
    const Point a = frame(ends[0]), b = frame(ends[1]);
    fmt::format_to(std::back_inserter(data), "M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
  }
  return data.empty() ? "" : fmt::format("<path class=\"joint\" d=\"{}\"/>\n", data);
}

/// A triangle below nodes that are clamped, a circle beside those that slide along a face.
std::string supports(const Structure& bridge, const Frame& frame) {
  std::string elements;
  const double middle = 0.5 * (bridge.mesh.nodes.row(0).minCoeff() + bridge.mesh.nodes.row(0).maxCoeff());
  for (const Support& support : bridge.supports)
    for (const NodeId node : support.nodes) {
      const Point p = frame(bridge.mesh.position(node));
      const double aside = bridge.mesh.position(node).x() < middle ? -4.0 : 4.0;
      if (support.holds_y)
        elements += fmt::format("<path class=\"support\" d=\"M{0:.1f} {1:.1f}l-4 7h8z\"/>\n", p.x(), p.y());
      else
        elements += fmt::format("<circle class=\"roller\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>\n",
                                p.x() + aside, p.y());
    }
  return elements;
}

std::string control_points(const Structure& bridge, const Frame& frame) {
  std::string elements;
  for (const ControlPoint& point : bridge.control_points) {
    const Point p = frame(point.position);
    elements += fmt::format(
        "<circle class=\"point\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"><title>{} ({:.4g}, "
        "{:.4g})</title></circle>\n",
        p.x(), p.y(), escaped(point.name), point.position.x(), point.position.y());
  }
  return elements;
}

/// Names of the sensors that the bridge file adds to the control points, below their places.
std::string sensor_names(const Structure& bridge, const BridgeDescription& description, const Frame& frame) {
  std::string elements;
  const std::size_t first = bridge.control_points.size() - description.sensors.size();
  for (const ControlPoint& point : std::span(bridge.control_points).subspan(first)) {
    const double half = 0.32 * kLabelHeight * static_cast<double>(point.name.size());
    const Point p = frame(point.position);
    elements += text_at({std::clamp(p.x(), half, frame.width - half), p.y() + 11.0}, "name", point.name);
  }
  return elements;
}

/// A line between the two places of each sensor of a distance.
std::string gauges(const BridgeDescription& description, const Frame& frame) {
  std::string elements;
  for (const SensorDescription& sensor : description.sensors) {
    if (!sensor.from || !sensor.to) continue;
    const Point a = frame(*sensor.from), b = frame(*sensor.to);
    elements +=
        fmt::format("<path class=\"gauge\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"><title>{}</title></path>\n",
                    a.x(), a.y(), b.x(), b.y(), escaped(sensor.name));
  }
  return elements;
}

/// What the signs and colours mean; of loads if there are any.
std::string legend(const BlockLayout& layout, const BridgeDescription& description) {
  std::string text =
      "<tspan class=\"point\">\u25cf</tspan> points that are read  "
      "<tspan class=\"held\">\u25b3</tspan> held  <tspan class=\"held\">\u25cb</tspan> slides along";
  if (!description.loads.empty())
    text += "  <tspan class=\"loads\">\u2193</tspan> loads, vehicles at their first place";
  std::string roles;
  for (const std::string_view role : kRoleNames)
    if (std::ranges::any_of(layout.blocks, [&](const Block& block) { return name_of(block.role) == role; }))
      roles +=
          fmt::format("{0}<tspan class=\"swatch {1}\">\u25a0</tspan> {1}", roles.empty() ? "" : "  ", role);
  return fmt::format(
      "<text class=\"key\" x=\"{0}\" y=\"36\">{1}</text>\n<text class=\"key\" x=\"{0}\" "
      "y=\"52\">{2}</text>\n",
      0.5 * kLeastWidth, text, roles);
}

/// 1, 2 or 5 times a power of ten, so that numbers along an axis have room [m].
double step_between_numbers(const Frame& frame, Eigen::Index axis) {
  constexpr double kSign = 7.0, kLeastAcross = 45.0, kLeastUp = 40.0;  // [px]
  const double least = (axis == 0 ? kLeastAcross : kLeastUp) / frame.scale;
  const auto has_room = [&](double step) {
    const auto width = [&](double at) {
      return kSign * static_cast<double>(fmt::format("{:g}", std::ceil(at / step) * step).size() + 1);
    };
    return step >= least &&
           (axis == 1 || std::max(width(frame.low.x()), width(frame.high.x())) <= step * frame.scale);
  };
  for (double power = std::pow(10.0, std::floor(std::log10(least)));; power *= 10.0)
    for (const double factor : {1.0, 2.0, 5.0})
      if (has_room(factor * power)) return factor * power;
}

/// Numbers along x and y.
std::string scales(const Frame& frame) {
  std::string elements;
  for (const Eigen::Index axis : {0, 1}) {
    const double step = step_between_numbers(frame, axis);
    for (double at = std::ceil(frame.low[axis] / step) * step; at <= frame.high[axis] + 1e-9; at += step) {
      Point place = frame.low;
      place[axis] = at;
      const Point p = frame(place) + (axis == 0 ? Point(0.0, 30.0) : Point(-30.0, 4.0));
      elements += text_at(p, "", fmt::format("{:g}", at + 0.0));
    }
  }
  const Point corner = frame(frame.low);
  return elements + text_at({frame.width - 0.4 * kMargin, corner.y() + 30.0}, "", "x [m]") +
         text_at({corner.x() - 30.0, frame(frame.high).y() - 14.0}, "", "y [m]");
}

std::string title(const Model& bridge, const BridgeDescription& description) {
  const std::size_t sensors = description.sensors.size();
  return fmt::format("{}: {} blocks, {} of them in rings; {} joints, {} control points{}{}", description.name,
                     bridge.block_count(), bridge.layout.count_with(BlockRole::ring), bridge.joints.size(),
                     bridge.control_points.size() - sensors,
                     sensors == 0 ? "" : fmt::format(", {} sensor{}", sensors, sensors == 1 ? "" : "s"),
                     bridge.symmetry ? "; its own mirror image" : "");
}

}  // namespace

std::string bridge_drawing(const Model& bridge, const BridgeDescription& description) {
  const std::vector<Soil> pieces = TopSurface(bridge.mesh).soil(description.fill.surface);
  const Frame frame(bridge, pieces, description.loads.size());
  const std::string heading = title(bridge, description);
  const LoadFrame across{kMargin - frame.scale * frame.low.x(),
                         frame.scale,
                         frame.low.x(),
                         frame.high.x(),
                         frame.width,
                         frame(frame.high).y()};
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
             "{0:.0f} {1:.0f}\" style=\"max-width:100%;height:auto\" role=\"img\" aria-label=\"{2}\">\n"
             "<style>:root{{{3}}}\n@media screen and "
             "(prefers-color-scheme:dark){{:root{{{4}}}}}\n{5}</style>\n"
             "<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n",
             frame.width, frame.height(), escaped(heading), kLightColours, kDarkColours, kStyle) +
         text_at({0.5 * kLeastWidth, 20.0}, "big", heading) + legend(bridge.layout, description) +
         soil(pieces, description.fill.unit_weight, frame) + blocks(bridge.layout, frame) +
         joints(bridge, frame) + labels(bridge, frame) + supports(bridge, frame) +
         gauges(description, frame) + control_points(bridge, frame) +
         sensor_names(bridge, description, frame) + load_elements(bridge, description, across) +
         scales(frame) + "</svg>\n";
}

}  // namespace voussoir
