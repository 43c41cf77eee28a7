#include "lookup/report/report_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/not_a_number.h"
#include "core/text.h"
#include "core/units.h"
#include "lookup/report/report_words.h"

namespace voussoir {
namespace {

constexpr const char* kAcross = "sensor, from left to right";

/// Half the width of the noise band [m]: the bound of uniform noise, two standard deviations of the others.
double band_of(const PicturedAnswer& report, const SensorResidual& residual) {
  return (report.answer.noise->shape == NoiseShape::uniform ? 1.0 : 2.0) * residual.scale;
}

std::string band_in_words(const PicturedAnswer& report) {
  if (!report.answer.noise) return "";
  return fmt::format(
      " The line is what the answer lets expect{}, the band the noise, {}{}.{}",
      report.answer.known_bridge ? "" : " by all other readings",
      noise_in_words(*report.answer.noise, report.comparison),
      report.answer.noise->shape == NoiseShape::uniform ? "" : ", two standard deviations each way",
      report.answer.known_bridge
          ? ""
          : " Dashed is the first candidate as the bridge file states it, without what joints, stone, "
            "temperature and supports have added.");
}

/// Sensors of one quantity under one load, with the name of their set and of the figures' ids.
struct PointSet {
  std::string title, id;
  Quantity quantity = Quantity::uy;
  std::vector<std::size_t> points;
};

Chart profile_chart(const PicturedAnswer& report, const PointSet& set) {
  const std::vector<std::size_t>& points = set.points;
  Series readings{std::string(reading_word(report)), 1, Mark::points, {}, {}};
  Series fit{"expected", 0, Mark::line, {}, {}};
  Series stated{report.answer.known_bridge ? "" : "first candidate by the file", 3, Mark::dashes, {}, {}};
  Series band{report.answer.noise ? "noise" : "", 0, Mark::band, {}, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto number = static_cast<double>(i + 1);
    const double expected = kMillimetres * report.expected[points[i]];
    readings.x.push_back(number);
    readings.y.push_back(kMillimetres * report.shown.reading[points[i]]);
    readings.tips.push_back(point_tip(report, points[i]));
    if (!std::isnan(expected)) {  // lines join readings, however many points have none in between
      fit.x.push_back(number);
      fit.y.push_back(expected);
    }
    if (!report.answer.known_bridge) {
      stated.x.push_back(number);
      stated.y.push_back(kMillimetres * report.shown.expected[points[i]]);
    }
    const SensorResidual* const residual = residual_of(report, points[i]);
    const double half =
        residual != nullptr && report.answer.noise ? kMillimetres * band_of(report, *residual) : kNan;
    if (std::isnan(expected)) continue;
    band.x.push_back(number);
    band.y.push_back(expected - half);
    band.upper.push_back(expected + half);
  }
  return {set.title,
          {kAcross},
          {axis_in_words(report.comparison.kind, set.quantity)},
          {band, stated, fit, readings}};
}

Table profile_table(const PicturedAnswer& report, const PointSet& set) {
  const std::string_view unit = unit_of(set.quantity);
  const bool epochs = !report.comparison.before.empty();
  Table table{{"point", "x [m]", fmt::format("{} [{}]", reading_word(report), unit),
               fmt::format("expected [{}]", unit), fmt::format("noise, each way [{}]", unit)},
              {}};
  const bool is_uncertain = !report.answer.known_bridge;
  if (is_uncertain) table.columns.push_back(fmt::format("first candidate by the file [{}]", unit));
  if (epochs)
    table.columns.insert(table.columns.begin() + 2,
                         {fmt::format("before [{}]", unit), fmt::format("after [{}]", unit)});
  for (const std::size_t point : set.points) {
    const SensorResidual* const residual = residual_of(report, point);
    table.rows.push_back(
        {report.library.points[point].name, report.library.points[point].position.x(),
         kMillimetres * report.shown.reading[point], kMillimetres * report.expected[point],
         residual != nullptr && report.answer.noise ? kMillimetres * band_of(report, *residual) : kNan});
    if (is_uncertain) table.rows.back().push_back(kMillimetres * report.shown.expected[point]);
    if (epochs)
      table.rows.back().insert(
          table.rows.back().begin() + 2,
          {kMillimetres * report.comparison.before[point], kMillimetres * report.comparison.after[point]});
  }
  return table;
}

Chart residual_chart(const PicturedAnswer& report, const std::vector<std::size_t>& points,
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
  return {label, {kAcross}, {"residual in standard deviations"}, {agreeing, odd}};
}

Table residual_table(const PicturedAnswer& report, const PointSet& set) {
  Table table{
      {"point", fmt::format("residual [{}]", unit_of(set.quantity)), "in standard deviations", "verdict"},
      {}};
  for (const std::size_t point : set.points)
    if (const SensorResidual* const residual = residual_of(report, point))
      table.rows.push_back({report.library.points[point].name,
                            kMillimetres * (residual->reading - residual->predicted), residual->error,
                            residual->disagrees           ? "disagrees with the rest"
                            : std::isnan(residual->error) ? "cannot move"
                                                          : "agrees"});
  return table;
}

std::vector<std::string> loads_of(const PicturedAnswer& report) {
  std::vector<std::string> loads;
  for (const std::string& load : report.comparison.load)
    if (std::find(loads.begin(), loads.end(), load) == loads.end()) loads.push_back(load);
  return loads.empty() ? std::vector<std::string>{""} : loads;
}

/// Appends the set of the points that belong, if there are any.
template <class Belongs>
void add_set(const PicturedAnswer& report, const std::string& title, const std::string& id, Quantity quantity,
             const Belongs& belongs, std::vector<PointSet>& sets) {
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < report.library.points.size(); ++point)
    if (quantity_of(report.comparison, point) == quantity && belongs(point)) points.push_back(point);
  const auto is_read = [&](std::size_t point) { return std::isfinite(report.shown.reading[point]); };
  if (std::ranges::none_of(points, is_read)) return;
  const std::vector<std::string>& loads = report.comparison.load;
  const std::string under = loads.empty() ? "" : under_load(loads[points.front()]);
  std::vector<std::string> names;
  for (const std::size_t point : points) {
    const std::string& name = report.library.points[point].name;
    names.push_back(name.substr(0, name.size() - under.size()));
  }
  sets.push_back({title + ", " + names_in_words(names) + under, id, quantity, points});
}

std::vector<PointSet> point_sets(const PicturedAnswer& report) {
  std::vector<PointSet> sets;
  int count = 1;
  std::string number;  // of the load, from the second on
  for (const std::string& load : loads_of(report)) {
    const auto under = [&](std::size_t point) {
      return load.empty() || report.comparison.load[point] == load;
    };
    const auto at = [&](Site site) {
      return [&, site](std::size_t point) { return under(point) && site_of(report, point) == site; };
    };
    add_set(report, "Top", "top" + number, Quantity::uy, at(Site::top), sets);
    add_set(report, "Arch", "arch" + number, Quantity::uy, at(Site::arch), sets);
    add_set(report, "Wall", "wall" + number, Quantity::uy, at(Site::elsewhere), sets);
    add_set(report, "Horizontal", "horizontal" + number, Quantity::ux, under, sets);
    add_set(report, "Tilts", "tilt" + number, Quantity::tilt, under, sets);
    add_set(report, "Distances", "distance" + number, Quantity::distance, under, sets);
    number = fmt::format("-{}", ++count);
  }
  return sets;
}

std::string residuals_in_words(const PicturedAnswer& report) {
  return report.answer.known_bridge
             ? "Reading minus first candidate, with an unknown datum, tilt or scale as far as the readings "
               "show it, in units of the noise at that sensor (the bound of uniform noise, else the "
               "standard deviation)."
             : "Reading minus what the likeliest scenes and all other readings let expect, in standard "
               "deviations of that.";
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
    figures.push_back({"profile-" + set.id, set.title, sign_in_words(set.quantity) + band_in_words(report),
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
    figures.push_back({"residual-" + set.id, "Residuals: " + set.title, residuals_in_words(report),
                       chart_html(residual_chart(report, set.points, set.title)), residual_table(report, set),
                       false, TableView::printed});
  }
  return figures;
}

}  // namespace voussoir
