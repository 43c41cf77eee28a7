#include "lookup/report/report_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/not_a_number.h"
#include "core/units.h"
#include "lookup/checks/fewer_readings.h"
#include "lookup/report/point_sets.h"
#include "lookup/report/reading_words.h"
#include "lookup/report/report_words.h"

namespace voussoir {
namespace {

/// A line through fewer readings than three says nothing.
bool has_line(const PicturedAnswer& report, const PointSet& set) {
  return std::ranges::count_if(
             set.points, [&](std::size_t point) { return std::isfinite(report.shown.reading[point]); }) >= 3;
}

/// The axis of the sensors, each by its name.
ChartAxis sensors_axis(const PointSet& set) {
  const bool has_gaps = set.names.size() > set.points.size();
  return named_axis(
      has_gaps ? "sensor, course by course, each from left to right" : "sensor, from left to right",
      set.names);
}

/// Of uniform noise residuals are in units of its bound, else of a standard deviation.
bool is_bounded(const PicturedAnswer& report) {
  return report.answer.known_bridge && report.answer.noise->shape == NoiseShape::uniform;
}

/// Half the width of the band about what is expected [m]: the bound of uniform noise, two standard deviations
/// of all others.
double band_of(const PicturedAnswer& report, std::size_t point) {
  const SensorResidual* const residual = residual_of(report, point);
  if (residual == nullptr || !report.answer.noise) return kNan;
  return (is_bounded(report) ? 1.0 : 2.0) * residual->scale;
}

std::string band_in_words(const PicturedAnswer& report, const PointSet& set) {
  if (!report.answer.noise) return "";
  const std::string_view mark = has_line(report, set) ? "Line" : "Black";
  const std::string noise = noise_in_words(*report.answer.noise, report.comparison);
  if (report.answer.known_bridge)
    return fmt::format(" {}: the first candidate. Band: the noise, {}{}.", mark, noise,
                       is_bounded(report) ? "" : ", two standard deviations each way");
  return fmt::format(
      " {}: the reading expected from all other readings. Band: two standard deviations of a reading about "
      "that, with what they leave open of the bridge and with the noise, {}. Dashed: the first candidate as "
      "the bridge file states it, without what joints, stone, temperature and supports have added.",
      mark, noise);
}

/// What is drawn of one set; values in millimetres.
struct ProfileSeries {
  Series readings, fit, stated, band, silent;
};

/// Lines join readings, however many points have none in between, but no two courses.
void interrupt(double place, ProfileSeries& series) {
  for (Series* const line : {&series.fit, &series.stated, &series.band}) {
    line->x.push_back(place);
    line->y.push_back(kNan);
  }
  series.band.upper.push_back(kNan);
}

void add_point(const PicturedAnswer& report, std::size_t point, double place, ProfileSeries& series) {
  const double reading = kMillimetres * report.shown.reading[point];
  const double expected = kMillimetres * report.expected[point];
  const double half = kMillimetres * band_of(report, point);
  Series& discs = report.comparison.measured.silent[point] ? series.silent : series.readings;
  discs.x.push_back(place);
  discs.y.push_back(reading);
  discs.tips.push_back(point_tip(report, point));
  if (!report.answer.known_bridge) {
    series.stated.x.push_back(place);
    series.stated.y.push_back(kMillimetres * report.shown.expected[point]);
  }
  if (std::isnan(expected)) return;
  series.fit.x.push_back(place);
  series.fit.y.push_back(expected);
  series.band.x.push_back(place);
  series.band.y.push_back(expected - half);
  series.band.upper.push_back(expected + half);
}

ProfileSeries profile_series(const PicturedAnswer& report, const PointSet& set) {
  const bool is_known = report.answer.known_bridge;
  const bool joined = has_line(report, set);
  ProfileSeries series{
      {std::string(reading_word(report)), 1, Mark::points, {}, {}},
      {"expected", 0, joined ? Mark::line : Mark::ticks, {}, {}},
      {is_known ? "" : "first candidate by the file", 3, joined ? Mark::dashes : Mark::ticks, {}, {}},
      {!report.answer.noise ? ""
       : is_known           ? "noise"
                            : "two standard deviations",
       0,
       Mark::band,
       {},
       {}},
      {"", 0, Mark::hollow, {}, {}}};
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    if (i > 0 && (!joined || set.places[i] > set.places[i - 1] + 1.5)) interrupt(set.places[i] - 0.5, series);
    add_point(report, set.points[i], set.places[i], series);
  }
  if (!series.silent.x.empty()) series.silent.name = "no reading";
  return series;
}

Chart profile_chart(const PicturedAnswer& report, const PointSet& set) {
  const ProfileSeries series = profile_series(report, set);
  return {set.title,
          sensors_axis(set),
          {axis_in_words(report.comparison.kind, set.quantity)},
          {series.band, series.stated, series.fit, series.readings, series.silent}};
}

Table profile_table(const PicturedAnswer& report, const PointSet& set) {
  const std::string_view unit = unit_of(set.quantity);
  const bool epochs = !report.comparison.before.empty();
  Table table{{"point", "x [m]", fmt::format("{} [{}]", reading_word(report), unit),
               fmt::format("expected [{}]", unit), fmt::format("band, each way [{}]", unit)},
              {}};
  const bool is_uncertain = !report.answer.known_bridge;
  if (is_uncertain) table.columns.push_back(fmt::format("first candidate by the file [{}]", unit));
  if (epochs)
    table.columns.insert(table.columns.begin() + 2,
                         {fmt::format("before [{}]", unit), fmt::format("after [{}]", unit)});
  table.decimals.assign(table.columns.size(), report.decimals);
  table.decimals[1] = 2;
  for (const std::size_t point : set.points) {
    table.rows.push_back({report.library.points[point].name, report.library.points[point].position.x(),
                          kMillimetres * report.shown.reading[point], kMillimetres * report.expected[point],
                          kMillimetres * band_of(report, point)});
    if (is_uncertain) table.rows.back().push_back(kMillimetres * report.shown.expected[point]);
    if (epochs)
      table.rows.back().insert(
          table.rows.back().begin() + 2,
          {kMillimetres * report.comparison.before[point], kMillimetres * report.comparison.after[point]});
  }
  return table;
}

/// Where disagreement begins; nothing where there are too few sensors to say, or they are not judged.
std::optional<double> shown_limit(const PicturedAnswer& report) {
  const double limit = limit_of_agreement(report.answer.residuals);
  const bool says_something = std::isfinite(limit) && limit > 0.0 && are_sensors_judged(report.answer);
  return says_something ? std::optional(limit) : std::nullopt;
}

/// Dashed from end to end.
std::vector<Series> limit_series(const PicturedAnswer& report, const PointSet& set) {
  const std::optional<double> limit = shown_limit(report);
  if (!limit) return {};
  const std::vector<double> ends = {0.4, static_cast<double>(set.names.size()) + 0.6};
  return {{"limit of agreement", 2, Mark::dashes, ends, {*limit, *limit}},
          {"", 2, Mark::dashes, ends, {-*limit, -*limit}}};
}

Chart residual_chart(const PicturedAnswer& report, const PointSet& set) {
  Series agreeing{are_sensors_judged(report.answer) ? "agrees" : "residual", 1, Mark::points, {}, {}};
  Series odd{"disagrees with the rest", 2, Mark::points, {}, {}};
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    const SensorResidual* const residual = residual_of(report, set.points[i]);
    if (residual == nullptr) continue;
    Series& series = residual->disagrees ? odd : agreeing;
    series.x.push_back(set.places[i]);
    series.y.push_back(residual->error);
    series.tips.push_back(point_tip(report, set.points[i]));
  }
  if (odd.x.empty()) odd.name.clear();
  Chart chart{set.title,
              sensors_axis(set),
              {is_bounded(report) ? "residual in bounds of the noise" : "residual in standard deviations"},
              limit_series(report, set)};
  chart.series.push_back(agreeing);
  chart.series.push_back(odd);
  return chart;
}

Table residual_table(const PicturedAnswer& report, const PointSet& set) {
  Table table{{"point", fmt::format("residual [{}]", unit_of(set.quantity)),
               is_bounded(report) ? "in bounds of the noise" : "in standard deviations", "verdict"},
              {},
              {kAsNeeded, report.decimals, 2, kAsNeeded}};
  for (const std::size_t point : set.points)
    if (const SensorResidual* const residual = residual_of(report, point))
      table.rows.push_back({report.library.points[point].name,
                            kMillimetres * (residual->reading - residual->predicted), residual->error,
                            residual->disagrees                 ? "disagrees with the rest"
                            : std::isnan(residual->error)       ? "cannot move"
                            : are_sensors_judged(report.answer) ? "agrees"
                                                                : "not judged"});
  return table;
}

std::string residuals_in_words(const PicturedAnswer& report) {
  return report.answer.known_bridge
             ? fmt::format(
                   "Reading minus first candidate, with an unknown datum, tilt or scale as far as the "
                   "readings show it, in {} of the noise at that sensor.",
                   is_bounded(report) ? "bounds" : "standard deviations")
             : "Reading minus what all other readings let expect, in standard deviations of a reading about "
               "that.";
}

/// Nothing where no limit is drawn.
std::string limit_in_words(const PicturedAnswer& report) {
  const std::optional<double> limit = shown_limit(report);
  if (!limit) return "";
  return fmt::format(
      " Beyond the dashed lines ({:.1f}, eight times what half of all sensors reach) a sensor disagrees with "
      "the rest.",
      *limit);
}

std::string sign_in_words(Quantity quantity) {
  switch (quantity) {
    case Quantity::ux:
      return "To the left is negative.";
    case Quantity::tilt:
      return "Clockwise is negative.";
    case Quantity::distance:
      return "Shorter is negative.";
    default:
      return "Downward is negative.";
  }
}

}  // namespace

std::vector<Figure> profile_figures(const PicturedAnswer& report) {
  std::vector<Figure> figures;
  for (const PointSet& set : point_sets(report))
    figures.push_back({"profile-" + set.id, set.title,
                       sign_in_words(set.quantity) + band_in_words(report, set),
                       chart_html(profile_chart(report, set)), profile_table(report, set)});
  return figures;
}

std::vector<Figure> residual_figures(const PicturedAnswer& report) {
  if (report.answer.residuals.empty()) return {};
  std::vector<Figure> figures;
  for (const PointSet& set : point_sets(report)) {
    if (std::ranges::none_of(set.points,
                             [&](std::size_t point) { return residual_of(report, point) != nullptr; }))
      continue;
    figures.push_back(
        {"residual-" + set.id, "Residuals: " + set.title, residuals_in_words(report) + limit_in_words(report),
         chart_html(residual_chart(report, set)), residual_table(report, set), false, TableView::printed});
  }
  return figures;
}

}  // namespace voussoir
