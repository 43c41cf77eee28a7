#include "lookup/report/report_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/not_a_number.h"
#include "core/units.h"
#include "lookup/answer/verdict.h"
#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

constexpr double kWorthColour = 0.001;  // blocks less likely to be missing look like any stone
constexpr double kPictureWidth = 1040.0;
constexpr double kReadingsHeight = 1.1;   // [m] above the bridge, for the top's readings
constexpr double kLongestReading = 0.75;  // [m] on the bridge's scale
constexpr double kSensorDisc = 3.0;

double probability_of(const PicturedAnswer& report, BlockId block) {
  if (!has_probabilities(report.answer)) return kNan;
  return report.answer.posterior->block_probability[static_cast<std::size_t>(value(block))];
}

std::string block_tip(const PicturedAnswer& report, BlockId id) {
  const double probability = probability_of(report, id);
  return fmt::format(
      "Block ({})\n{}\n{}", report.library.layout[id].label, place_in_words(id, report.library.layout),
      std::isnan(probability) ? "no probability" : "missing with probability " + percent(probability));
}

BlockLook block_look(const PicturedAnswer& report, BlockId id) {
  const double probability = probability_of(report, id);
  const bool coloured = probability >= kWorthColour;
  return {coloured ? fmt::format("block m{}", colour_level(probability)) : "stone", block_tip(report, id)};
}

std::string best_scene_marks(const PicturedAnswer& report, const BridgeFrame& frame) {
  std::string elements;
  for (const BlockId id : report.answer.candidates.front().scene.removed) {
    const Block& block = report.library.layout[id];
    elements += path_element("mark", closed_path(placed(block.polygon, frame))) + block_label(block, frame);
  }
  return elements;
}

/// Whether the picture shows the reading as a line: heights, under the first load if there are several.
bool hangs(const PicturedAnswer& report, std::size_t point) {
  return quantity_of(report.comparison, point) == Quantity::uy &&
         (report.comparison.load.empty() || report.comparison.load[point] == report.comparison.load.front());
}

/// A sensor with its reading as a line that hangs from it: from the intrados into the opening, and on top
/// from a line above the bridge.
std::string reading_element(const PicturedAnswer& report, const BridgeFrame& frame, std::size_t point,
                            double units_a_metre) {
  const double lift = site_of(report, point) == Site::top ? kReadingsHeight - 0.2 : 0.0;
  const Point at = frame(report.library.points[point].position + Point(0.0, lift));
  const double reading = report.shown.reading[point];
  const bool silent = std::isnan(reading);
  const int colour = disagrees(report, point) ? 2 : 1;
  const std::string stem =
      silent || !hangs(report, point)
          ? ""
          : path_element(fmt::format("line s{}", colour),
                         fmt::format("M{:.1f} {:.1f}v{:.2f}", at.x(), at.y(), -reading * units_a_metre));
  return stem + fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n",
                            silent ? "silent" : fmt::format("f{}", colour), at.x(), at.y(), kSensorDisc,
                            tip_element(point_tip(report, point)));
}

/// [m] on the bridge's scale that the top's longest upward line needs above the others' start.
double room_above(const PicturedAnswer& report, double longest) {
  double upward = 0.0;
  for (std::size_t point = 0; point < report.shown.reading.size(); ++point)
    if (hangs(report, point)) upward = std::max(upward, report.shown.reading[point]);
  return longest > 0.0 ? kLongestReading * upward / longest : 0.0;
}

double largest_reading(const PicturedAnswer& report) {
  double largest = 0.0;
  for (std::size_t point = 0; point < report.shown.reading.size(); ++point)
    if (hangs(report, point) && !std::isnan(report.shown.reading[point]))
      largest = std::max(largest, std::abs(report.shown.reading[point]));
  return largest;
}

Table block_table(const PicturedAnswer& report) {
  Table table{{"block", "probability", "where"}, {}};
  if (!has_probabilities(report.answer)) {
    for (const BlockId id : report.answer.candidates.front().scene.removed)
      table.rows.push_back(
          {report.library.layout[id].label, "none", place_in_words(id, report.library.layout)});
    return table;
  }
  for (const BlockId id : likely_blocks(*report.answer.posterior, kWorthColour))
    table.rows.push_back({report.library.layout[id].label, percent(probability_of(report, id)),
                          place_in_words(id, report.library.layout)});
  return table;
}

}  // namespace

Drawing draw_bridge(const PicturedAnswer& report) {
  const double longest = largest_reading(report);
  const BridgeFrame frame =
      frame_of(report.library.layout, kPictureWidth, kReadingsHeight + room_above(report, longest), 0.15);
  const bool with_bar = has_probabilities(report.answer);
  Drawing drawing{frame.width, frame.height + (with_bar ? kColourBarHeight : 0.0),
                  with_bar ? "The bridge; each block coloured by the probability that it is missing"
                           : "The bridge; the first candidate's blocks outlined",
                  ""};
  drawing.elements =
      ground_element(report.library.layout, frame) +
      block_elements(report.library.layout, frame, [&](BlockId id) { return block_look(report, id); }) +
      best_scene_marks(report, frame);
  const double units = longest > 0.0 ? kLongestReading * frame.scale / longest : 0.0;
  for (std::size_t point = 0; point < report.library.points.size(); ++point)
    drawing.elements += reading_element(report, frame, point, units);
  if (with_bar)
    drawing.elements +=
        colour_bar({"probability that the block is missing", {"0", "25 %", "50 %", "75 %", "100 %"}},
                   drawing.width, drawing.height);
  return drawing;
}

Figure bridge_figure(const PicturedAnswer& report) {
  const double longest = kMillimetres * largest_reading(report);
  return {
      "bridge",
      has_probabilities(report.answer) ? "The bridge, and how likely each block is missing"
                                       : "The bridge and the first candidate",
      fmt::format(
          "{} Outlined: the first candidate. Blue lines hang from the control points by their {}s (the "
          "longest is {:.3g} mm; the top's hang from above the bridge); a hollow point has no reading, an "
          "orange one disagrees with the rest.",
          has_probabilities(report.answer)
              ? "Blocks that are missing with less than 0.1 % have the colour of stone."
          : report.answer.posterior ? "No block is coloured, as no scene is an answer."
                                    : "With this objective there are no probabilities.",
          reading_word(report), longest),
      panorama_html(draw_bridge(report)),
      block_table(report),
      true,
      TableView::printed};
}

}  // namespace voussoir
