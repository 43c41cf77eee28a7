#include "lookup/report/report_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"
#include "lookup/report/report_words.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

constexpr double kMillimetres = 1e3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kWorthColour = 0.001;  // blocks less likely to be missing look like any stone
constexpr double kPictureWidth = 1040.0;
constexpr double kReadingsHeight = 1.1;   // [m] above the bridge, for the top's readings
constexpr double kLongestReading = 0.75;  // [m] on the bridge's scale
constexpr double kDisc = 3.0;
constexpr const char* kAcross = "control point, from left to right";

bool on_arch(const ReportPictures& report, std::size_t point) {
  return report.library.layout[report.library.points[point].block].role == BlockRole::ring;
}

std::span<const double> best_fit(const ReportPictures& report) {
  return report.library.table.row(report.answer.candidates.front().row);
}

const SensorResidual* residual_of(const ReportPictures& report, std::size_t point) {
  const auto& residuals = report.answer.residuals;
  const auto found = std::find_if(residuals.begin(), residuals.end(),
                                  [&](const SensorResidual& residual) { return residual.point == point; });
  return found == residuals.end() ? nullptr : &*found;
}

bool disagrees(const ReportPictures& report, std::size_t point) {
  const SensorResidual* const residual = residual_of(report, point);
  return residual != nullptr && residual->disagrees;
}

/// Half the width of the noise band [m]: the bound of uniform noise, two standard deviations of the others.
double band_of(const ReportPictures& report, const SensorResidual& residual) {
  return (report.answer.noise->shape == NoiseShape::uniform ? 1.0 : 2.0) * residual.scale;
}

std::string band_in_words(const ReportPictures& report) {
  if (!report.answer.noise) return "";
  return fmt::format(
      " The band is the noise, {}{}.", noise_in_words(*report.answer.noise),
      report.answer.noise->shape == NoiseShape::uniform ? "" : ", two standard deviations each way");
}

// -- the bridge ---------------------------------------------------------------------------------------------

double probability_of(const ReportPictures& report, BlockId block) {
  if (!report.answer.posterior) return kNan;
  return report.answer.posterior->block_probability[static_cast<std::size_t>(value(block))];
}

std::string block_tip(const ReportPictures& report, BlockId id) {
  const double probability = probability_of(report, id);
  return fmt::format("Block ({})\n{}\n{}", to_string(report.library.layout[id].index),
                     place_in_words(id, report.library.layout),
                     std::isnan(probability) ? "no probabilities with this objective"
                                             : "missing with probability " + percent(probability));
}

BlockLook block_look(const ReportPictures& report, BlockId id) {
  const double probability = probability_of(report, id);
  const bool coloured = probability >= kWorthColour;
  return {coloured ? fmt::format("block m{}", colour_level(probability)) : "stone", block_tip(report, id)};
}

std::string best_scene_marks(const ReportPictures& report, const BridgeFrame& frame) {
  std::string elements;
  for (const BlockId id : report.answer.candidates.front().scene.removed) {
    const Block& block = report.library.layout[id];
    elements += path_element("mark", closed_path(placed(block.polygon, frame))) + block_label(block, frame);
  }
  return elements;
}

std::string point_tip(const ReportPictures& report, std::size_t point) {
  const std::string& name = report.library.points[point].name;
  const double reading = report.measurements.displacement[point];
  const double expected = best_fit(report)[point];
  if (std::isnan(reading))
    return fmt::format("{}\n{}", name, report.measurements.silent[point] ? "no reading" : "no sensor");
  return fmt::format("{}\nreading {:.4g} mm\nfirst candidate {:.4g} mm{}", name, kMillimetres * reading,
                     kMillimetres * expected, disagrees(report, point) ? "\ndisagrees with the rest" : "");
}

/// A control point with its reading as a line that hangs from it: from the intrados into the opening, and on
/// top from a line above the bridge.
std::string reading_element(const ReportPictures& report, const BridgeFrame& frame, std::size_t point,
                            double units_a_metre) {
  const double lift = on_arch(report, point) ? 0.0 : kReadingsHeight - 0.2;
  const Point at = frame(report.library.points[point].position + Point(0.0, lift));
  const double reading = report.measurements.displacement[point];
  const bool silent = std::isnan(reading);
  const int colour = disagrees(report, point) ? 2 : 1;
  const std::string stem =
      silent ? ""
             : path_element(fmt::format("line s{}", colour),
                            fmt::format("M{:.1f} {:.1f}v{:.2f}", at.x(), at.y(), -reading * units_a_metre));
  return stem + fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n",
                            silent ? "silent" : fmt::format("f{}", colour), at.x(), at.y(), kDisc,
                            tip_element(point_tip(report, point)));
}

double largest_reading(const ReportPictures& report) {
  double largest = 0.0;
  for (const double reading : report.measurements.displacement)
    if (!std::isnan(reading)) largest = std::max(largest, std::abs(reading));
  return largest;
}

Table block_table(const ReportPictures& report) {
  Table table{{"block", "probability", "where"}, {}};
  if (!report.answer.posterior) {
    for (const BlockId id : report.answer.candidates.front().scene.removed)
      table.rows.push_back({to_string(report.library.layout[id].index), "none asked for",
                            place_in_words(id, report.library.layout)});
    return table;
  }
  for (const BlockId id : likely_blocks(*report.answer.posterior, kWorthColour))
    table.rows.push_back({to_string(report.library.layout[id].index), percent(probability_of(report, id)),
                          place_in_words(id, report.library.layout)});
  return table;
}

// -- profiles and residuals ---------------------------------------------------------------------------------

std::vector<std::size_t> points_of(const ReportPictures& report, bool arch) {
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < report.library.points.size(); ++point)
    if (on_arch(report, point) == arch) points.push_back(point);
  return points;
}

Chart profile_chart(const ReportPictures& report, const std::vector<std::size_t>& points,
                    const std::string& label) {
  Series readings{"reading", 1, Mark::points, {}, {}};
  Series fit{"first candidate", 0, Mark::line, {}, {}};
  Series band{report.answer.noise ? "noise" : "", 0, Mark::band, {}, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto number = static_cast<double>(i + 1);
    const double expected = kMillimetres * best_fit(report)[points[i]];
    readings.x.push_back(number);
    readings.y.push_back(kMillimetres * report.measurements.displacement[points[i]]);
    readings.tips.push_back(point_tip(report, points[i]));
    fit.x.push_back(number);
    fit.y.push_back(expected);
    const SensorResidual* const residual = residual_of(report, points[i]);
    const double half =
        residual != nullptr && report.answer.noise ? kMillimetres * band_of(report, *residual) : kNan;
    band.x.push_back(number);
    band.y.push_back(expected - half);
    band.upper.push_back(expected + half);
  }
  return {label, {kAcross}, {"vertical displacement [mm]"}, {band, fit, readings}};
}

Table profile_table(const ReportPictures& report, const std::vector<std::size_t>& points) {
  Table table{{"point", "x [m]", "reading [mm]", "first candidate [mm]", "noise, each way [mm]"}, {}};
  for (const std::size_t point : points) {
    const SensorResidual* const residual = residual_of(report, point);
    table.rows.push_back(
        {report.library.points[point].name, report.library.points[point].position.x(),
         kMillimetres * report.measurements.displacement[point], kMillimetres * best_fit(report)[point],
         residual != nullptr && report.answer.noise ? kMillimetres * band_of(report, *residual) : kNan});
  }
  return table;
}

Chart residual_chart(const ReportPictures& report, const std::vector<std::size_t>& points,
                     const std::string& label) {
  Series agreeing{"agrees", 1, Mark::points, {}, {}};
  Series odd{"disagrees with the rest", 2, Mark::points, {}, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SensorResidual* const residual = residual_of(report, points[i]);
    if (residual == nullptr) continue;
    Series& series = residual->disagrees ? odd : agreeing;
    series.x.push_back(static_cast<double>(i + 1));
    series.y.push_back(residual->error);
    series.tips.push_back(point_tip(report, points[i]));
  }
  if (odd.x.empty()) odd.name.clear();
  return {label, {kAcross}, {"residual in units of the noise"}, {agreeing, odd}};
}

Table residual_table(const ReportPictures& report, const std::vector<std::size_t>& points) {
  Table table{{"point", "residual [mm]", "in units of the noise", "verdict"}, {}};
  for (const std::size_t point : points)
    if (const SensorResidual* const residual = residual_of(report, point))
      table.rows.push_back({report.library.points[point].name,
                            kMillimetres * (residual->reading - residual->predicted), residual->error,
                            residual->disagrees           ? "disagrees with the rest"
                            : std::isnan(residual->error) ? "cannot move"
                                                          : "agrees"});
  return table;
}

/// The points on top and on the arch, each with the name of its set and of the figures' ids.
struct PointSet {
  std::string title, id;
  std::vector<std::size_t> points;
};

std::vector<PointSet> point_sets(const ReportPictures& report) {
  std::vector<PointSet> sets;
  for (const bool arch : {false, true}) {
    const std::vector<std::size_t> points = points_of(report, arch);
    if (!points.empty())
      sets.push_back(
          {fmt::format("{}, {} to {}", arch ? "Arch" : "Top", report.library.points[points.front()].name,
                       report.library.points[points.back()].name),
           arch ? "arch" : "top", points});
  }
  return sets;
}

}  // namespace

Drawing draw_bridge(const ReportPictures& report) {
  const BridgeFrame frame = frame_of(report.library.layout, kPictureWidth, kReadingsHeight, 0.15);
  const bool with_bar = report.answer.posterior.has_value();
  Drawing drawing{frame.width, frame.height + (with_bar ? kColourBarHeight : 0.0),
                  "The bridge; each block coloured by the probability that it is missing", ""};
  drawing.elements =
      ground_element(report.library.layout, frame) +
      block_elements(report.library.layout, frame, [&](BlockId id) { return block_look(report, id); }) +
      best_scene_marks(report, frame);
  const double longest = largest_reading(report);
  const double units = longest > 0.0 ? kLongestReading * frame.scale / longest : 0.0;
  for (std::size_t point = 0; point < report.library.points.size(); ++point)
    drawing.elements += reading_element(report, frame, point, units);
  if (with_bar)
    drawing.elements +=
        colour_bar({"probability that the block is missing", {"0", "25 %", "50 %", "75 %", "100 %"}},
                   drawing.width, drawing.height);
  return drawing;
}

Figure bridge_figure(const ReportPictures& report) {
  const bool probabilities = report.answer.posterior.has_value();
  const double longest = kMillimetres * largest_reading(report);
  return {
      "bridge",
      "The bridge and what is missing",
      fmt::format(
          "{} Outlined: the first candidate. Blue lines hang from the control points by their readings (the "
          "longest is {:.3g} mm; the top's hang from above the bridge); a hollow point has no reading, an "
          "orange one disagrees with the rest.",
          probabilities ? "Blocks that are missing with less than 0.1 % have the colour of stone."
                        : "With this objective there are no probabilities.",
          longest),
      panorama_html(draw_bridge(report)),
      block_table(report),
      true,
      TableView::printed};
}

std::vector<Figure> profile_figures(const ReportPictures& report) {
  std::vector<Figure> figures;
  for (const PointSet& set : point_sets(report))
    figures.push_back({"profile-" + set.id, set.title, "Downward is negative." + band_in_words(report),
                       chart_html(profile_chart(report, set.points, set.title)),
                       profile_table(report, set.points)});
  return figures;
}

std::vector<Figure> residual_figures(const ReportPictures& report) {
  if (report.answer.residuals.empty()) return {};
  std::vector<Figure> figures;
  for (const PointSet& set : point_sets(report))
    figures.push_back(
        {"residual-" + set.id, "Residuals: " + set.title,
         "Reading minus first candidate, in units of the noise at that sensor (the bound of uniform "
         "noise, else the standard deviation).",
         chart_html(residual_chart(report, set.points, set.title)), residual_table(report, set.points), false,
         TableView::printed});
  return figures;
}

}  // namespace voussoir
