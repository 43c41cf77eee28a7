#include "lookup/report/report_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/not_a_number.h"
#include "lookup/answer/verdict.h"
#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"
#include "lookup/report/report_stems.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

constexpr double kWorthColour = 0.01;  // blocks less likely to be missing look like any stone
constexpr double kWorthListing = 0.001;
constexpr double kPictureWidth = 1040.0;
constexpr double kKeyHeight = 30.0;

double probability_of(const PicturedAnswer& report, BlockId block) {
  if (!has_probabilities(report.answer)) return kNan;
  return report.answer.posterior->block_probability[static_cast<std::size_t>(value(block))];
}

/// How much likelier the readings are with the loss of this block alone than with none, of losses that are
/// not excluded; else nothing.
std::optional<double> open_loss_of(const PicturedAnswer& report, BlockId block) {
  for (const OpenLoss& loss : report.open_losses)
    if (report.library.table.scene(loss.row).lacks(block)) return loss.times_as_likely;
  return std::nullopt;
}

std::string block_tip(const PicturedAnswer& report, BlockId id) {
  const double probability = probability_of(report, id);
  return fmt::format(
      "Block ({})\n{}\n{}{}", report.library.layout[id].label, place_in_words(id, report.library.layout),
      std::isnan(probability) ? "no probability" : "missing with probability " + percent(probability),
      open_loss_of(report, id) ? "\nits loss is not excluded" : "");
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

/// The blocks whose loss is not excluded, the likeliest first.
std::vector<BlockId> open_blocks(const PicturedAnswer& report) {
  std::vector<BlockId> blocks;
  for (const OpenLoss& loss : report.open_losses)
    std::ranges::copy(report.library.table.scene(loss.row).removed, std::back_inserter(blocks));
  return blocks;
}

/// Likely blocks, then those whose loss is not excluded; without probabilities the first candidate's.
std::vector<BlockId> listed_blocks(const PicturedAnswer& report) {
  if (!has_probabilities(report.answer)) return report.answer.candidates.front().scene.removed;
  std::vector<BlockId> blocks = likely_blocks(*report.answer.posterior, kWorthListing);
  for (const BlockId id : open_blocks(report))
    if (std::ranges::find(blocks, id) == blocks.end()) blocks.push_back(id);
  return blocks;
}

Table block_table(const PicturedAnswer& report) {
  Table table{{"block", "probability", "where"}, {}};
  const bool has_open = !report.open_losses.empty();
  if (has_open) table.columns.emplace_back("its loss");
  for (const BlockId id : listed_blocks(report)) {
    const double probability = probability_of(report, id);
    table.rows.push_back({report.library.layout[id].label,
                          std::isnan(probability) ? "none" : percent(probability),
                          place_in_words(id, report.library.layout)});
    if (!has_open) continue;
    const std::optional<double> times = open_loss_of(report, id);
    table.rows.back().emplace_back(
        times ? fmt::format("not excluded: readings {:.2f} times as likely as without it", *times) : "");
  }
  return table;
}

/// What colours, lines and stripes mean, below the bridge.
std::string keys(const PicturedAnswer& report, const Drawing& drawing, const BridgeFrame& frame) {
  const bool has_open = !report.open_losses.empty();
  const double bottom = drawing.height - (has_open ? kKeyHeight : 0.0);
  std::string elements = stem_scale(report, {14.0, bottom - kColourBarHeight + 16.0}) +
                         metre_scale(frame, {drawing.width - 14.0, bottom - kColourBarHeight + 36.0});
  if (has_probabilities(report.answer)) {
    std::vector<BarMark> marks = percent_marks();
    marks.erase(marks.begin());  // there is the field of stone
    elements += colour_bar(
        {"probability that the block is missing", marks, fmt::format("< {:g} %", 100.0 * kWorthColour)},
        drawing.width, bottom);
  }
  if (has_open) elements += stripes_key({0.36 * drawing.width, bottom + 6.0}, "its loss is not excluded");
  return elements;
}

std::string colours_in_words(const PicturedAnswer& report) {
  if (has_probabilities(report.answer))
    return fmt::format("Blocks that are missing with less than {:g} % have the colour of stone.",
                       100.0 * kWorthColour);
  return report.answer.posterior ? "No block is coloured, as no scene is an answer."
                                 : "With this objective there are no probabilities.";
}

/// Of what is there alone.
std::string signs_in_words(const PicturedAnswer& report) {
  const ShownStems shown = shown_stems(report);
  std::string text;
  if (!report.answer.candidates.front().scene.removed.empty()) text += " Outlined: the first candidate.";
  if (!report.open_losses.empty()) text += " Striped: blocks whose loss is not excluded; the table has all.";
  if (shown.lines)
    text +=
        fmt::format(" Lines hang from the sensors by their {}s{}{}; those with names are the largest{}.",
                    reading_word(report), shown.lifted ? ", the top's from above the bridge" : "",
                    cuts_stems(report) ? ", arrows go on" : "", shown.odd ? " and those that disagree" : "");
  if (shown.silent) text += " A hollow point has no reading.";
  if (shown.odd) text += " An orange one disagrees with the rest.";
  return text;
}

}  // namespace

Drawing draw_bridge(const PicturedAnswer& report) {
  const BridgeFrame frame = frame_below(room_for_stems(report), report.library.layout, kPictureWidth);
  const bool has_open = !report.open_losses.empty();
  Drawing drawing{frame.width, frame.height + kColourBarHeight + (has_open ? kKeyHeight : 0.0),
                  has_probabilities(report.answer)
                      ? "The bridge; each block coloured by the probability that it is missing"
                      : "The bridge; the first candidate's blocks outlined",
                  ""};
  drawing.elements =
      ground_element(report.library.layout, frame) +
      block_elements(report.library.layout, frame, [&](BlockId id) { return block_look(report, id); }) +
      striped_blocks(open_blocks(report), report.library.layout, frame) + best_scene_marks(report, frame) +
      stem_elements(report, frame) + keys(report, drawing, frame);
  return drawing;
}

Figure bridge_figure(const PicturedAnswer& report) {
  return {"bridge",
          has_probabilities(report.answer) ? "The bridge, and how likely each block is missing"
                                           : "The bridge and the first candidate",
          colours_in_words(report) + signs_in_words(report),
          panorama_html(draw_bridge(report)),
          block_table(report),
          true,
          TableView::printed};
}

}  // namespace voussoir
