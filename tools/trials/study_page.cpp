#include <fmt/format.h>

#include <algorithm>

#include "core/units.h"
#include "lookup/report/drawing/page.h"
#include "lookup/report/drawing/style.h"
#include "tools/trials/study_report.h"

namespace voussoir {
namespace {

constexpr double kPerCent = 100.0;
constexpr int kUnknownColour = 1, kKnownColour = 2;

std::string bridge_word(const StudyRow& row) {
  return row.known_bridge ? "known" : "unknown";
}

/// What was stated against what was true, with bars of three standard errors.
void add_reliability(const std::vector<StudyRow>& rows, bool known_bridge, Chart& chart, Table& table) {
  const std::string name = known_bridge ? "bridge taken as known" : "bridge taken as unknown";
  Series bars{
      name + ", three standard errors", known_bridge ? kKnownColour : kUnknownColour, Mark::band, {}, {}, {}};
  Series points{name, known_bridge ? kKnownColour : kUnknownColour, Mark::beads, {}, {}};
  for (const ReliabilityBin& bin : joined_bins(rows, known_bridge)) {
    if (bin.scenes == 0) continue;
    points.x.push_back(kPerCent * bin.mean_probability);
    points.y.push_back(kPerCent * bin.frequency);
    bars.x.push_back(kPerCent * bin.mean_probability);
    bars.y.push_back(kPerCent * (bin.mean_probability - 3.0 * bin.standard_error));
    bars.upper.push_back(kPerCent * (bin.mean_probability + 3.0 * bin.standard_error));
    table.rows.push_back({name, static_cast<double>(bin.scenes), kPerCent * bin.mean_probability,
                          kPerCent * bin.frequency, kPerCent * bin.standard_error});
  }
  if (!known_bridge) chart.series.push_back(bars);
  chart.series.push_back(points);
}

Figure reliability_figure(const std::vector<StudyRow>& rows) {
  Chart chart{"Stated probability against how often it was the truth",
              {"stated probability [%]", AxisScale::linear, {{0.0, 100.0}}},
              {"was the truth [%]", AxisScale::linear, {{0.0, 100.0}}},
              {{"perfect", 0, Mark::dashes, {0.0, 100.0}, {0.0, 100.0}}}};
  Table table{
      {"bridge", "scenes", "mean stated probability [%]", "was the truth [%]", "standard error if right [%]"},
      {}};
  for (const bool known_bridge : {false, true}) add_reliability(rows, known_bridge, chart, table);
  return {.id = "reliability",
          .title = "Reliability",
          .caption =
              "Every scene of every answer that was given at least 0.1 %, by the probability that it was "
              "given. The band is three standard errors wide to each side of what was stated.",
          .pictures = chart_html(chart),
          .table = std::move(table),
          .view = TableView::printed};
}

/// One way of taking readings: how often the truth came first, by the error of the readings.
Figure success_figure(const std::vector<StudyRow>& rows, ReadingsTaken taken) {
  Chart chart{fmt::format("{}: truth first among singles", to_string(taken)),
              {"error of a reading [mm]", AxisScale::logarithmic},
              {"truth first [%]", AxisScale::linear, {{0.0, 100.0}}},
              {}};
  Table table{{"truth", "bridge", "sigma [mm]", "first [%]", "standard error [%]"}, {}};
  for (const StudyRow& row : rows) {
    if (row.taken != taken || row.looked_for != "singles among singles") continue;
    const std::string name = fmt::format("{}, {}", row.truth, bridge_word(row));
    auto series = std::ranges::find(chart.series, name, &Series::name);
    if (series == chart.series.end()) {
      const int colour = static_cast<int>(chart.series.size()) % kSeriesColours;
      chart.series.push_back({name, colour, Mark::beads, {}, {}});
      series = chart.series.end() - 1;
    }
    series->x.push_back(kMillimetres * row.sigma);
    series->y.push_back(kPerCent * row.rates.first.value);
    table.rows.push_back({row.truth, bridge_word(row), kMillimetres * row.sigma,
                          kPerCent * row.rates.first.value, kPerCent * row.rates.first.standard_error});
  }
  return {.id = fmt::format("first-{}", static_cast<int>(taken)),
          .title = fmt::format("Readings: {}", to_string(taken)),
          .caption = "How often the missing block comes first among all singles.",
          .pictures = chart_html(chart),
          .table = std::move(table)};
}

/// A share and its standard error.
void add_share(const Share& share, std::vector<TableCell>& cells) {
  cells.emplace_back(kPerCent * share.value);
  cells.emplace_back(kPerCent * share.standard_error);
}

std::vector<std::string> columns() {
  std::vector<std::string> names = {"truth", "looked for", "readings", "sigma [mm]", "bridge", "trials"};
  for (const char* share : {"first [%]", "in the 95 % set [%]", "in a set of exactly 95 % [%]",
                            "wrong, over 90 % [%]", "called damaged [%]", "names a sound block [%]"})
    names.insert(names.end(), {share, "+-"});
  names.insert(names.end(), {"scenes in the 95 % set", "Brier"});
  for (const Verdict verdict : all_verdicts()) names.emplace_back(to_string(verdict));
  return names;
}

Table table_of(const std::vector<StudyRow>& rows) {
  Table table{columns(), {}};
  for (const StudyRow& row : rows) {
    const TrialRates& rates = row.rates;
    std::vector<TableCell> cells = {row.truth,
                                    row.looked_for,
                                    std::string(to_string(row.taken)),
                                    kMillimetres * row.sigma,
                                    bridge_word(row),
                                    static_cast<double>(rates.trials)};
    for (const Share& share : {rates.first, rates.in_credible, rates.in_exact, rates.wrong_and_sure,
                               rates.alarm, rates.names_sound})
      add_share(share, cells);
    cells.emplace_back(rates.mean_set_size);
    cells.emplace_back(rates.mean_brier);
    for (const std::size_t count : rates.verdicts) cells.emplace_back(static_cast<double>(count));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::string source_html(const StudySource& source) {
  return section_html("made", "How this page was made",
                      terms_html({{"Database", source.database},
                                  {"Digest", source.digest},
                                  {"Bridge", source.bridge},
                                  {"True bridges", fmt::format("{}", fmt::join(source.truths, "; "))},
                                  {"Load", source.settings.load.empty() ? "none" : source.settings.load},
                                  {"How bridges scatter",
                                   source.settings.sampled ? fmt::format("{} sampled bridges of the database",
                                                                         source.settings.sampled->count)
                                                           : "first order"},
                                  {"Seed of the errors", fmt::format("{}", source.settings.seed)},
                                  {"Standard errors", "between bridges, whose scenes are not independent"}}));
}

}  // namespace

std::string to_page(const StudySource& source, const std::vector<StudyRow>& rows) {
  std::vector<Figure> figures = {reliability_figure(rows)};
  for (const ReadingsTaken taken : all_taken(source.settings)) figures.push_back(success_figure(rows, taken));
  return html_page(
      "Voussoir: trials on irregular bridges",
      paragraph("Readings of sampled bridges, solved nonlinearly, that the database does not hold.", "lead") +
          section_html("figures", "What was found", figures_html(figures)) +
          section_html("all", "All series", to_html(table_of(rows), 3)) + source_html(source));
}

}  // namespace voussoir
