#include "generator/bridge_drawing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/structure/loads.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr double kWidth = 1200.0;     ///< [px] of the picture
constexpr double kMargin = 50.0;      ///< [px] on all sides, with the scale
constexpr double kLabelHeight = 9.0;  ///< [px]

constexpr const char* kStyle =
    "text{font:9px sans-serif;fill:#222;text-anchor:middle}.big{font-size:13px}\n"
    "path{stroke:#666;stroke-width:.5}.wall{fill:#e4d9c4}.ring{fill:#d6a77a}.pier{fill:#cbbfa6}"
    ".abutment{fill:#bfb49c}.parapet{fill:#efe7d6}.backing{fill:#c9c9c0}.fill{fill:#d9cdb0;fill-opacity:.6}\n"
    ".joint{stroke:#000;stroke-width:1}.support{fill:none;stroke:#06c;stroke-width:1.5}"
    ".roller{fill:#fff;stroke:#06c}.point{fill:#c00}.load{stroke:#b00;stroke-width:2;fill:none}"
    "\n";

/// From places on the bridge to the picture.
struct Frame {
  Point low, high;
  double scale;

  explicit Frame(const Mesh& mesh)
      : low(mesh.nodes.rowwise().minCoeff()),
        high(mesh.nodes.rowwise().maxCoeff()),
        scale((kWidth - 2.0 * kMargin) / (high.x() - low.x())) {}
  Point operator()(const Point& p) const {
    return {kMargin + scale * (p.x() - low.x()), 1.5 * kMargin + scale * (high.y() - p.y())};
  }
  double height() const { return 3.0 * kMargin + scale * (high.y() - low.y()); }
};

std::string text_at(const Point& at, const char* css_class, const std::string& text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", css_class, at.x(), at.y(),
                     escaped(text));
}

std::string blocks(const BlockLayout& layout, const Frame& frame) {
  std::string elements;
  for (const Block& block : layout.blocks) {
    std::string data;
    for (const Point& corner : block.polygon) {
      const Point p = frame(corner);
      fmt::format_to(std::back_inserter(data), "{}{:.1f} {:.1f}", data.empty() ? 'M' : 'L', p.x(), p.y());
    }
    elements += fmt::format("<path class=\"{0}\" d=\"{1}Z\"><title>{2} {0}, {3:.3f} m2</title></path>\n",
                            name_of(block.role), data, escaped(block.label), area(block.polygon));
  }
  return elements;
}

/// Labels of the blocks in which they have room.
std::string labels(const BlockLayout& layout, const Frame& frame) {
  std::string elements;
  for (const Block& block : layout.blocks) {
    const double room = frame.scale * std::sqrt(area(block.polygon));
    if (room < 0.6 * kLabelHeight * static_cast<double>(block.label.size())) continue;
    elements += text_at(frame(centroid(block.polygon)) + Point(0.0, 3.0), "", block.label);
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
        "<circle class=\"point\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"><title>{}</title></circle>\n", p.x(),
        p.y(), escaped(point.name));
  }
  return elements;
}

/// The nodes on which the first stage of each load case acts, as arrows; the longest is a margin long.
std::string loads(const Model& bridge, const BridgeDescription& description, const Frame& frame) {
  std::string elements;
  for (const LoadDescription& load : description.loads) {
    const std::vector<LoadStage> stages = load_stages(load, bridge, description.material.thickness);
    const Field& force = stages.front().force;
    const double largest = force.row(1).cwiseAbs().maxCoeff();
    for (int node = 0; node < bridge.mesh.node_count(); ++node) {
      const double share = largest > 0.0 ? -force(1, node) / largest : 0.0;
      if (share <= 0.0) continue;
      const Point p = frame(bridge.mesh.nodes.col(node));
      elements += fmt::format(
          "<path class=\"load\" d=\"M{0:.1f} {1:.1f}v{2:.1f}m-3 -6l3 6l3 -6\"><title>{3}: {4:.4g} "
          "kN</title></path>\n",
          p.x(), p.y() - 0.8 * kMargin * share, 0.8 * kMargin * share,
          escaped(stages.front().name) + ", on the bridge's whole thickness", -1e-3 * force(1, node));
    }
  }
  return elements;
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
  const Frame frame(bridge.mesh);
  const std::string heading = title(bridge, description);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
             "{0:.0f} "
             "{1:.0f}\" role=\"img\" aria-label=\"{2}\">\n<style>{3}</style>\n<rect width=\"100%\" "
             "height=\"100%\" "
             "fill=\"#fff\"/>\n",
             kWidth, frame.height(), escaped(heading), kStyle) +
         text_at({0.5 * kWidth, 20.0}, "big", heading) + blocks(bridge.layout, frame) +
         joints(bridge, frame) + labels(bridge.layout, frame) + supports(bridge, frame) +
         control_points(bridge, frame) + loads(bridge, description, frame) + scales(frame) + "</svg>\n";
}

}  // namespace voussoir
