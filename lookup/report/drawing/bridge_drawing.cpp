#include "lookup/report/drawing/bridge_drawing.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/structure/block_boxes.h"
#include "lookup/report/drawing/colour_map.h"

namespace voussoir {
namespace {

constexpr double kSide = 0.25;     // [m] free at the left and right
constexpr double kBarShare = 0.5;  // of the frame's width
constexpr double kBarThickness = 12.0;

}  // namespace

BridgeFrame frame_of(const BlockLayout& layout, double width, double above, double below) {
  const Box box = box_of(layout.blocks);
  BridgeFrame frame;
  frame.scale = width / (box.sizes().x() + 2.0 * kSide);
  frame.left = box.min().x() - kSide;
  frame.top = box.max().y() + above;
  frame.width = width;
  frame.height = frame.scale * (frame.top - box.min().y() + below);
  return frame;
}

std::vector<Point> placed(const Polygon& polygon, const BridgeFrame& frame) {
  std::vector<Point> points;
  for (const Point& corner : polygon) points.push_back(frame(corner));
  return points;
}

std::string block_elements(const BlockLayout& layout, const BridgeFrame& frame,
                           const std::function<BlockLook(BlockId)>& look) {
  std::string elements;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const BlockLook block = look(BlockId{static_cast<std::int32_t>(i)});
    elements +=
        path_element(block.css_class, closed_path(placed(layout.blocks[i].polygon, frame)), block.tip);
  }
  return elements;
}

std::string block_label(const Block& block, const BridgeFrame& frame) {
  Point at(frame(centroid(block.polygon)).x(), frame.height);
  for (const Point& corner : block.polygon) at.y() = std::min(at.y(), frame(corner).y() - 4.0);
  return text_element(at, "middle", "label", "(" + block.label + ")");
}

std::string ground_element(const BlockLayout& layout, const BridgeFrame& frame) {
  const Box box = box_of(layout.blocks);
  const Point left = frame(box.min());
  return path_element("axis", fmt::format("M{:.1f} {:.1f}H{:.1f}", left.x() - 6.0, left.y() + 1.0,
                                          frame(box.max()).x() + 6.0));
}

std::string colour_bar(const ColourBar& bar, double width, double height) {
  const double length = kBarShare * width;
  const double left = 0.5 * (width - length);
  const double top = height - kColourBarHeight + 32.0;
  std::string elements = text_element({0.5 * width, top - 8.0}, "middle", "", bar.title);
  for (int level = 0; level < kColourLevels; ++level)
    elements +=
        fmt::format("<rect class=\"m{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\"/>\n", level,
                    left + length * level / kColourLevels, top, length / kColourLevels, kBarThickness);
  for (std::size_t i = 0; i < bar.marks.size(); ++i) {
    const double share =
        static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(1, bar.marks.size() - 1));
    elements +=
        text_element({left + length * share, top + kBarThickness + 20.0}, "middle", "small", bar.marks[i]);
  }
  return elements;
}

}  // namespace voussoir
