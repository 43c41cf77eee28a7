#include "lookup/report/drawing/bridge_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/structure/block_boxes.h"
#include "lookup/report/drawing/axis.h"
#include "lookup/report/drawing/colour_map.h"

namespace voussoir {
namespace {

constexpr double kSide = 0.25;     // [m] free at the left and right
constexpr double kBelow = 0.15;    // [m] free below the bridge
constexpr double kBarShare = 0.5;  // of the frame's width
constexpr double kBarThickness = 12.0;
constexpr double kStoneField = 34.0;
constexpr double kBeforeBar = 34.0;   // free between a field of stone and the bar
constexpr double kScaleShare = 0.16;  // of the frame's width, at most

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

BridgeFrame frame_below(double room, const BlockLayout& layout, double width) {
  const double scale = frame_of(layout, width, 0.0, 0.0).scale;
  return frame_of(layout, width, room / scale, kBelow);
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

std::vector<BarMark> percent_marks() {
  return {{0.0, "0"}, {0.25, "25 %"}, {0.5, "50 %"}, {0.75, "75 %"}, {1.0, "100 %"}};
}

std::vector<BarMark> round_marks(double at_lowest, double at_highest) {
  if (!(std::abs(at_highest - at_lowest) > 0.0)) return {{0.0, fmt::format("{:.3g}", at_lowest)}};
  const bool rises = at_highest > at_lowest;
  const AxisMap values = {std::min(at_lowest, at_highest), std::max(at_lowest, at_highest), rises ? 0.0 : 1.0,
                          rises ? 1.0 : 0.0, AxisScale::linear};
  std::vector<BarMark> marks;
  for (const Tick& tick : ticks_of(values, kBarMarks)) marks.push_back({values(tick.value), tick.text});
  return marks;
}

std::string colour_bar(const ColourBar& bar, double width, double height) {
  const double length = kBarShare * width;
  const double left = 0.5 * (width - length);
  const double top = height - kColourBarHeight + 38.0;
  std::string elements = text_element({0.5 * width, top - 13.0}, "middle", "", bar.title);
  const auto field = [&](const std::string& look, double from, double across) {
    elements += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\"/>\n",
                            look, from, top, across, kBarThickness);
  };
  for (int level = 0; level < kColourLevels; ++level)
    field(fmt::format("m{}", level), left + length * level / kColourLevels, length / kColourLevels);
  for (const BarMark& mark : bar.marks)
    elements +=
        text_element({left + length * mark.share, top + kBarThickness + 22.0}, "middle", "small", mark.text);
  if (bar.stone.empty()) return elements;
  field("stone", left - kStoneField - kBeforeBar, kStoneField);
  return elements + text_element({left - 0.5 * kStoneField - kBeforeBar, top + kBarThickness + 22.0},
                                 "middle", "small", bar.stone);
}

std::string metre_scale(const BridgeFrame& frame, const Point& right_end) {
  const double metres = round_below(kScaleShare * frame.width / frame.scale);
  const double length = metres * frame.scale;
  const double left = right_end.x() - length;
  return path_element("axis",
                      fmt::format("M{0:.1f} {1:.1f}v8m0-4h{2:.1f}m0-4v8", left, right_end.y(), length)) +
         text_element({left + 0.5 * length, right_end.y() + 24.0}, "middle", "small",
                      fmt::format("{:g} m", metres));
}

std::string striped_blocks(std::span<const BlockId> blocks, const BlockLayout& layout,
                           const BridgeFrame& frame) {
  if (blocks.empty()) return "";
  std::string elements =
      "<defs><pattern id=\"stripes\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><path class=\"stripe\" d=\"M3.5 0V7\"/></pattern></defs>\n";
  for (const BlockId block : blocks)
    elements += path_element("striped", closed_path(placed(layout[block].polygon, frame)));
  return elements;
}

std::string stripes_key(const Point& left_end, const std::string& meaning) {
  return fmt::format(
             "<rect class=\"stone\" x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2}\" height=\"{3}\"/>"
             "<rect class=\"striped\" x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2}\" height=\"{3}\"/>\n",
             left_end.x(), left_end.y(), kStoneField, kBarThickness) +
         text_element(left_end + Point(kStoneField + 8.0, kBarThickness - 1.0), "start", "", meaning);
}

}  // namespace voussoir
