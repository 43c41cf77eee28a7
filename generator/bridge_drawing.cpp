#include "generator/bridge_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>

#include "core/error.h"
#include "core/structure/loads.h"
#include "core/structure/top_surface.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr double kLeastWidth = 1200.0;  ///< [px] of the picture; wider where labels need it
constexpr double kMostWidth = 4800.0;
constexpr double kLoadRow = 30.0;          ///< [px] above the bridge, of each load case
constexpr double kMargin = 50.0;           ///< [px] on all sides, with the scale
constexpr double kLabelHeight = 9.0;       ///< [px]
constexpr double kSmallLabel = 2.0 / 3.0;  ///< [-] of the others' size, as in the style

constexpr const char* kStyle =
    "text{font:9px sans-serif;fill:#222;text-anchor:middle}"
    ".big{font-size:13px}.small{font-size:6px}.key{font-size:11px}\n"
    "path{stroke:#666;stroke-width:.5}.wall{fill:#e4d9c4}.ring{fill:#d6a77a}.pier{fill:#cbbfa6}"
    ".abutment{fill:#bfb49c}.parapet{fill:#efe7d6}.backing{fill:#c9c9c0}.fill{fill:#d9cdb0;fill-opacity:.6}\n"
    ".soil{fill:#e9e2d2;stroke:none}.gauge{stroke:#c00;stroke-width:1}\n"
    ".joint{stroke:#000;stroke-width:1}.support{fill:none;stroke:#06c;stroke-width:1.5}"
    ".roller{fill:#fff;stroke:#06c}.point{fill:#c00}.load{stroke:#b00;stroke-width:2;fill:none}"
    "\n";

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
        above(1.5 * kMargin + kLoadRow * static_cast<double>(load_cases)) {
    for (const Soil& piece : soil)
      for (const Point& corner : piece) high = high.cwiseMax(corner);
  }
  Point operator()(const Point& p) const {
    return {kMargin + scale * (p.x() - low.x()), above + scale * (high.y() - p.y())};
  }
  double height() const { return above + 1.5 * kMargin + scale * (high.y() - low.y()); }
};

std::string text_at(const Point& at, const char* css_class, const std::string& text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", css_class, at.x(), at.y(),
                     escaped(text));
}

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
      1e-3 * unit_weight);
}

/// Labels of the blocks in which they have room, small ones where that helps.
std::string labels(const BlockLayout& layout, const Frame& frame) {
  std::string elements;
  for (const Block& block : layout.blocks) {
    const double room = frame.scale * std::sqrt(area(block.polygon)) / label_width(block);
    if (room < kSmallLabel) continue;
    elements +=
        text_at(frame(centroid(block.polygon)) + Point(0.0, 3.0), room < 1.0 ? "small" : "", block.label);
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

/// Where a load case pushes: its points, its vehicle's axles at the first place, and lines as two ends [m].
std::vector<double> pushed_at(const LoadDescription& load) {
  std::vector<double> places;
  for (const PointLoad& point : load.points) places.push_back(point.x);
  if (!load.places.empty())
    for (const Axle& axle : load.axles) places.push_back(load.places.front() - axle.at);
  for (const LineLoad& line : load.lines) places.insert(places.end(), {line.from_x, line.to_x});
  return places;
}

/// A row above the bridge for each load case: arrows where it pushes, bars along lines.
std::string loads(const Model& bridge, const BridgeDescription& description, const Frame& frame) {
  constexpr double kArrow = 0.5 * kLoadRow;
  std::string elements;
  double base =
      frame(frame.high).y() - 0.3 * kLoadRow - kLoadRow * static_cast<double>(description.loads.size());
  for (const LoadDescription& load : description.loads) {
    base += kLoadRow;
    const LoadStage stage = load_stages(load, bridge, description.material.thickness).front();
    std::string data;
    const auto across = [&](double x) { return frame(Point(x, 0.0)).x(); };
    for (const LineLoad& line : load.lines)
      fmt::format_to(std::back_inserter(data), "M{:.1f} {:.1f}H{:.1f}", across(line.from_x), base - kArrow,
                     across(line.to_x));
    std::vector<double> places = pushed_at(load);
    std::erase_if(places, [&](double x) { return x < frame.low.x() || x > frame.high.x(); });
    for (const double x : places)
      fmt::format_to(std::back_inserter(data), "M{:.1f} {:.1f}v{:.1f}m-3 -6l3 6l3 -6", across(x),
                     base - kArrow, kArrow);
    const double sum = std::reduce(places.begin(), places.end());
    const double middle =
        places.empty() ? 0.5 * frame.width : across(sum / static_cast<double>(places.size()));
    const std::string name = fmt::format("{}, {:.4g} kN", stage.name, -1e-3 * stage.force.row(1).sum() + 0.0);
    elements +=
        fmt::format("<path class=\"load\" d=\"{}\"><title>{} on the bridge's thickness</title></path>\n",
                    data, escaped(name)) +
        text_at({std::clamp(middle, 0.3 * kLabelHeight * static_cast<double>(name.size()), frame.width),
                 base - kArrow - 3.0},
                "", name);
  }
  return elements;
}

/// What the signs mean; of loads if there are any.
std::string legend(const BridgeDescription& description) {
  std::string text =
      "<tspan fill=\"#c00\">\u25cf</tspan> sensors  "
      "<tspan fill=\"#06c\">\u25b3</tspan> held  <tspan fill=\"#06c\">\u25cb</tspan> slides along";
  if (!description.loads.empty())
    text +=
        "  <tspan fill=\"#b00\">\u2193</tspan> loads on the bridge's thickness, vehicles at their first "
        "place";
  return fmt::format("<text class=\"key\" x=\"{}\" y=\"36\">{}</text>\n", 0.5 * kLeastWidth, text);
}

/// Every metre, or every ten, so that numbers along an axis do not touch [m].
double step_between_numbers(const Frame& frame, Eigen::Index axis) {
  constexpr double kSign = 7.0, kBetween = 10.0;  // [px], of each and between numbers
  const double least = 16.0 / frame.scale;
  double step = std::pow(10.0, std::ceil(std::log10(least)));
  const auto width = [&](double at) {
    return kSign * static_cast<double>(fmt::format("{:g}", std::ceil(at / step) * step).size()) + kBetween;
  };
  while (axis == 0 && std::max(width(frame.low.x()), width(frame.high.x())) > step * frame.scale)
    step *= 10.0;
  return step;
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
  return elements;
}

std::string title(const Model& bridge, const BridgeDescription& description) {
  return fmt::format("{}: {} blocks, {} of them in rings; {} joints, {} control points{} [m]",
                     description.name, bridge.block_count(), bridge.layout.count_with(BlockRole::ring),
                     bridge.joints.size(), bridge.control_points.size(),
                     bridge.symmetry ? "; its own mirror image" : "");
}

}  // namespace

std::string bridge_drawing(const Model& bridge, const BridgeDescription& description) {
  const std::vector<Soil> pieces = TopSurface(bridge.mesh).soil(description.fill.surface);
  const Frame frame(bridge, pieces, description.loads.size());
  const std::string heading = title(bridge, description);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
             "{0:.0f} "
             "{1:.0f}\" role=\"img\" aria-label=\"{2}\">\n<style>{3}</style>\n<rect width=\"100%\" "
             "height=\"100%\" "
             "fill=\"#fff\"/>\n",
             frame.width, frame.height(), escaped(heading), kStyle) +
         text_at({0.5 * kLeastWidth, 20.0}, "big", heading) + legend(description) +
         soil(pieces, description.fill.unit_weight, frame) + blocks(bridge.layout, frame) +
         joints(bridge, frame) + labels(bridge.layout, frame) + supports(bridge, frame) +
         gauges(description, frame) + control_points(bridge, frame) + loads(bridge, description, frame) +
         scales(frame) + "</svg>\n";
}

}  // namespace voussoir
