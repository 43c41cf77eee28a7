#pragma once
/// @file Pictures of a bridge: its blocks, and quantities as their colours.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/structure/block_layout.h"
#include "lookup/report/drawing/svg.h"

namespace voussoir {

/// From places on the bridge [m] to the frame of a picture.
struct BridgeFrame {
  double left = 0.0;    ///< [m] x at the frame's left edge
  double top = 0.0;     ///< [m] y at the frame's upper edge
  double scale = 1.0;   ///< units a metre
  double width = 0.0;   ///< units
  double height = 0.0;  ///< units

  Point operator()(const Point& place) const {
    return {scale * (place.x() - left), scale * (top - place.y())};
  }
};

inline constexpr double kHeadingHeight = 0.75;  ///< [m] on the bridge's scale
inline constexpr int kBarMarks = 6;             ///< numbers beside a bar of colours, about

/// A frame `width` wide that holds the bridge and leaves `above` and `below` [m] free.
BridgeFrame frame_of(const BlockLayout& layout, double width, double above, double below);
/// The same with so much room above the bridge in the frame's units, for what stands there.
BridgeFrame frame_below(double room, const BlockLayout& layout, double width);

/// How one block is drawn.
struct BlockLook {
  std::string css_class = "stone";
  std::string tip;
};

/// Every block's polygon.
std::string block_elements(const BlockLayout& layout, const BridgeFrame& frame,
                           const std::function<BlockLook(BlockId)>& look);

/// A polygon on the bridge [m] in the frame.
std::vector<Point> placed(const Polygon& polygon, const BridgeFrame& frame);

/// The block's index, written above the block.
std::string block_label(const Block& block, const BridgeFrame& frame);

/// The ground that the bridge stands on.
std::string ground_element(const BlockLayout& layout, const BridgeFrame& frame);

/// A text beside a bar, at a share of its length.
struct BarMark {
  double share = 0.0;
  std::string text;
};

/// 0, 25 %, .. 100 %
std::vector<BarMark> percent_marks();

/// Round numbers between the values that the lowest and the highest level stand for.
std::vector<BarMark> round_marks(double at_lowest, double at_highest);

/// The colour levels from left to right, with what they mean.
struct ColourBar {
  std::string title;  ///< with its unit
  std::vector<BarMark> marks;
  std::string stone = {};  ///< what a field of stone before the lowest level means; empty: none
};

/// Units that a colour bar is high.
inline constexpr double kColourBarHeight = 78.0;

/// The bar, centred at the bottom of a frame of this size.
std::string colour_bar(const ColourBar& bar, double width, double height);

/// A round number of metres as a line, its right end at a place: about an eighth of the frame's width.
std::string metre_scale(const BridgeFrame& frame, const Point& right_end);

/// Stripes over blocks, under which their look stays, and what the stripes are made of: once in a picture.
std::string striped_blocks(std::span<const BlockId> blocks, const BlockLayout& layout,
                           const BridgeFrame& frame);

/// A field of stripes with what it means, its left end at a place.
std::string stripes_key(const Point& left_end, const std::string& meaning);

}  // namespace voussoir
