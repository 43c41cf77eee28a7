#include <fmt/format.h>
#include <limits>

#include "lookup/report/drawing/page.h"
#include "lookup/report/drawing/style.h"
#include "tools/validation/report.h"

namespace voussoir::validation {
namespace {

constexpr int kTableDigits = 5;

double number(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string known_answers(const std::vector<StudyResult>& results) {
  Table table{.columns = {"case", "quantity", "expected", "source", "computed", "error", "tolerance", "why",
                          "verdict"},
              .rows = {}};
  for (const StudyResult& result : results)
    for (const Case& c : result.findings.cases)
      table.rows.push_back({c.name, c.quantity, c.expected, c.source, c.computed, c.error,
                            number(c.tolerance), c.reason, mark(c)});
  return to_html(table, kTableDigits);
}

std::string hard_cases(const std::vector<StudyResult>& results) {
  Table table{.columns = {"sweep", "setting", "scene", "verdict", "expected", "error of the signal",
                          "iterations", ""},
              .rows = {}};
  for (const StudyResult& result : results)
    for (const HardCase& c : result.findings.hard_cases)
      table.rows.push_back({c.sweep, c.setting, c.scene, c.verdict, c.expected, number(c.error),
                            static_cast<double>(c.iterations), mark(c)});
  return to_html(table, 2);
}

std::string limits(const std::vector<StudyResult>& results) {
  std::string html;
  for (const StudyResult& result : results) {
    if (!result.failure.empty()) html += paragraph(result.title + " could not be run: " + result.failure);
    for (const std::string& note : result.findings.notes) html += paragraph(note);
  }
  return html;
}

ChartAxis axis(const std::string& label, bool logarithmic) {
  return {.label = label, .scale = logarithmic ? AxisScale::logarithmic : AxisScale::linear};
}

Chart chart_of(const Plot& plot) {
  Chart chart{.label = plot.title,
              .x = axis(plot.x_label, plot.log_x),
              .y = axis(plot.y_label, plot.log_y),
              .series = {}};
  int colour = 0;
  for (const Series& series : plot.series) {
    voussoir::Series drawn{.name = series.label,
                           .colour = colour++ % kSeriesColours,
                           .mark = !series.line                ? Mark::points
                                   : series.points.size() < 12 ? Mark::beads
                                                               : Mark::line,
                           .x = {},
                           .y = {}};
    for (const auto& [x, y] : series.points) {
      drawn.x.push_back(x);
      drawn.y.push_back(y);
    }
    chart.series.push_back(std::move(drawn));
  }
  return chart;
}

Table table_of(const Plot& plot) {
  Table table{.columns = {"series", plot.x_label, plot.y_label}, .rows = {}};
  for (const Series& series : plot.series)
    for (const auto& [x, y] : series.points) table.rows.push_back({series.label, x, y});
  return table;
}

std::string plots(const std::vector<StudyResult>& results) {
  std::vector<Figure> figures;
  for (const StudyResult& result : results)
    for (const Plot& plot : result.findings.plots)
      figures.push_back({.id = fmt::format("plot-{}", figures.size() + 1),
                         .title = plot.title,
                         .caption = {},
                         .pictures = chart_html(chart_of(plot)),
                         .table = table_of(plot)});
  return figures_html(figures);
}

}  // namespace

std::string to_page(const std::vector<StudyResult>& results) {
  double seconds = 0.0;
  for (const StudyResult& result : results) seconds += result.seconds;
  return html_page("Voussoir: known answers and hard cases",
                   paragraph(to_sentence(tally(results)) +
                             fmt::format(". Run time, all studies one after another: {:.0f} s.", seconds)) +
                       section_html("limits", "Limits and costs", limits(results)) +
                       section_html("plots", "Plots", plots(results)) +
                       section_html("known-answers", "Known answers", known_answers(results)) +
                       section_html("hard-cases", "Hard cases", hard_cases(results)));
}

}  // namespace voussoir::validation
