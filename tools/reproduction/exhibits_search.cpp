#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"
#include "lookup/search/misfit.h"
#include "tools/reproduction/exhibits.h"
#include "tools/reproduction/shares.h"

namespace voussoir {
namespace {

constexpr double kFound = 0.5;  // share of seeds

/// The number below which a share of the sorted numbers lies.
double quantile(const std::vector<int>& sorted, double part) {
  if (sorted.empty()) return std::nan("");
  return sorted[static_cast<std::size_t>(std::lround(part * static_cast<double>(sorted.size() - 1)))];
}

// -- Fig. 6 -------------------------------------------------------------------------------------------------

/// Eq. 1 of every block, when one is missing.
struct Misfits {
  BlockId truth{};
  std::vector<double> value;  ///< of each block
  double lowest = 0.0;        ///< of all blocks but the truth
  double highest = 0.0;       ///< of the wall: larger values are truncated
};

Misfits objective_of(const Subject& subject) {
  const SceneTable& table = subject.few;
  const std::size_t truth = subject.row(subject.cases.example.scene);
  Misfits result{table.scene(truth).removed.front(),
                 std::vector<double>(subject.database.layout().size(), std::nan("")),
                 std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const Measurements measured = as_measurements(table.row(truth));
  for (std::size_t row = 0; row < table.rows; ++row) {
    if (missing_blocks(table, row) != 1) continue;
    // Points of the candidate's missing block have no prediction: they stay out of the sum.
    std::vector<double> readings = measured.displacement;
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (std::isnan(table.row(row)[i])) readings[i] = std::nan("");
    const BlockId block = table.scene(row).removed.front();
    const double f = misfit(readings, table.row(row));
    result.value[static_cast<std::size_t>(value(block))] = f;
    if (block == result.truth) continue;
    result.lowest = std::min(result.lowest, f);
    if (subject.database.layout()[block].index.course > 0) result.highest = std::max(result.highest, f);
  }
  return result;
}

BlockLook look_of(const Misfits& objective, const BlockLayout& layout, BlockId id) {
  const double f = objective.value[static_cast<std::size_t>(value(id))];
  const std::string tip = fmt::format("({})\nf_v = {:.4g}", layout[id].label, f);
  if (std::isnan(f)) return {"stone", tip};
  const double depth = (objective.highest - f) / (objective.highest - objective.lowest);
  return {fmt::format("block m{}", colour_level(depth)), tip};
}

Drawing draw_objective(const Subject& subject, const Misfits& objective) {
  const BlockLayout& layout = subject.database.layout();
  const BridgeFrame frame = frame_of(layout, kBridgeWidth, 0.1, 0.15);
  Drawing drawing{frame.width, frame.height + kColourBarHeight, "Eq. 1 of every block", ""};
  drawing.elements =
      ground_element(layout, frame) +
      block_elements(layout, frame, [&](BlockId id) { return look_of(objective, layout, id); }) +
      path_element("mark", closed_path(placed(layout[objective.truth].polygon, frame))) +
      block_label(layout[objective.truth], frame) +
      colour_bar({"f_v, the better the fit the deeper the colour",
                  {{0.0, fmt::format("{:.2f} or more", objective.highest)},
                   {0.5, fmt::format("{:.2f}", 0.5 * (objective.highest + objective.lowest))},
                   {1.0, fmt::format("{:.2f} or less", objective.lowest)}}},
                 frame.width, frame.height + kColourBarHeight);
  return drawing;
}

Chart objective_chart(const Subject& subject, const Misfits& objective) {
  const BlockLayout& layout = subject.database.layout();
  Series wall{"a block of the wall", 1, Mark::points, {}, {}};
  Series arch{"a block of the arch", 2, Mark::points, {}, {}};
  Series truth{"the truth, truncated", 0, Mark::points, {}, {}};
  const double floor = std::floor(objective.lowest - 0.5);
  double ceiling = floor;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const BlockId id{static_cast<std::int32_t>(i)};
    const double f = objective.value[i];
    Series& series = id == objective.truth ? truth : layout[id].role == BlockRole::ring ? arch : wall;
    series.x.push_back(centroid(layout[id].polygon).x());
    series.y.push_back(std::max(f, floor));
    series.tips.push_back(look_of(objective, layout, id).tip);
    if (!std::isnan(f)) ceiling = std::max(ceiling, std::ceil(f));
  }
  truth.notes = {"(" + layout[objective.truth].label + ")"};
  Chart chart{"Eq. 1 over the place of the block",
              {"centre of the missing block, x [m]"},
              {"f_v"},
              {wall, arch, truth}};
  chart.y.range = {floor - 1.0, ceiling};
  return chart;
}

// -- Fig. 7 -------------------------------------------------------------------------------------------------

Chart found_chart(const std::vector<GenerationsAtNoise>& runs) {
  Series series{"", 1, Mark::beads, {}, {}};
  for (const GenerationsAtNoise& run : runs) {
    series.x.push_back(noise_per_cent(run.noise));
    series.y.push_back(kPerCent * share(static_cast<int>(run.generations.size()), run.seeds));
  }
  return {"Share of seeds that end at the truth",
          {"noise [%]"},
          {"seeds that end at the truth [%]", {}, {{0.0, 100.0}}},
          {series}};
}

Chart generations_chart(const Subject& subject, const std::vector<GenerationsAtNoise>& runs) {
  Series band{"10 to 90 % of the seeds that find it", 1, Mark::band, {}, {}};
  Series median{"median", 1, Mark::beads, {}, {}};
  for (const GenerationsAtNoise& run : runs) {
    band.x.push_back(noise_per_cent(run.noise));
    band.y.push_back(quantile(run.generations, 0.1));
    band.upper.push_back(quantile(run.generations, 0.9));
    median.x.push_back(noise_per_cent(run.noise));
    median.y.push_back(quantile(run.generations, 0.5));
  }
  Series paper{"the paper's Table 2", 2, Mark::points, {}, {}};
  for (const PaperCase& printed : subject.cases.one_block)
    if (printed.scene == subject.cases.example.scene && !printed.paper.empty() && printed.paper != "-") {
      paper.x.push_back(noise_per_cent(printed.noise));
      paper.y.push_back(std::stod(printed.paper));
    }
  if (paper.x.empty()) paper.name.clear();
  return {"Generations to convergence against noise",
          {"noise [%]"},
          {"generations to convergence"},
          {band, median, paper}};
}

std::string paper_result(const PaperCase& printed) {
  return printed.paper.empty() ? "not tried" : printed.paper == "-" ? "not found" : printed.paper;
}

/// The paper's verdict: "27 and -" means that one of two blocks was not found.
bool found_in_paper(const PaperCase& printed) {
  return !printed.paper.empty() && printed.paper.find('-') == std::string::npos;
}

std::string comparison(const CaseResult& result) {
  if (result.paper_case.paper.empty()) return "";
  if (found_in_paper(result.paper_case) == found(result)) return "agrees";
  return found(result) ? "differs: found here" : "differs: not found here";
}

}  // namespace

bool found(const CaseResult& result) {
  return share(result.genetic_found, result.paper_objective.trials) >= kFound;
}

Exhibit objective_exhibit(const Subject& subject) {
  const Misfits objective = objective_of(subject);
  const BlockLayout& layout = subject.database.layout();
  Table table{{"block", "course x1", "position x2", "f_v"}, {}};
  for (std::size_t i = 0; i < layout.size(); ++i)
    table.rows.push_back({layout.blocks[i].label, static_cast<double>(layout.blocks[i].index.course),
                          static_cast<double>(layout.blocks[i].index.position), objective.value[i]});
  const double depth = objective.value[static_cast<std::size_t>(value(objective.truth))];
  return {
      {"figure-6",
       fmt::format("Fig. 6: objective over all blocks, {} missing", as_printed(subject.cases.example.scene)),
       fmt::format("Eq. 1 without noise, over the control points that both scenes have. At the truth f_v = "
                   "{:.4g}; the next block has {:.4g}. Values are "
                   "truncated for the colours as the bar says and at the truth in the chart.",
                   depth, objective.lowest),
       panorama_html(draw_objective(subject, objective)) + chart_html(objective_chart(subject, objective)),
       table, true}};
}

Exhibit generations_exhibit(const Subject& subject, const std::vector<GenerationsAtNoise>& runs) {
  Table table{{"noise [%]", "seeds", "seeds that end at the truth", "generations, 10 %",
               "generations, median", "generations, 90 %"},
              {}};
  for (const GenerationsAtNoise& run : runs)
    table.rows.push_back({noise_per_cent(run.noise), static_cast<double>(run.seeds),
                          static_cast<double>(run.generations.size()), quantile(run.generations, 0.1),
                          quantile(run.generations, 0.5), quantile(run.generations, 0.9)});
  const GeneticSettings settings;
  return {
      {"figure-7",
       fmt::format("Fig. 7: noise against generations, {} missing", as_printed(subject.cases.example.scene)),
       fmt::format(
           "Genetic search with the paper's settings (population {}, crossover {}, mutation {}), {} seeds at "
           "each level, {} generations each. A run counts as found if its best scene in the end is the "
           "truth.",
           settings.population, settings.crossover, settings.mutation, subject.settings.trials,
           settings.most_generations),
       "<div class=\"figures\"><div>" + chart_html(generations_chart(subject, runs)) + "</div><div>" +
           chart_html(found_chart(runs)) + "</div></div>",
       table, true}};
}

Exhibit table_exhibit(const Subject& subject, const std::vector<CaseResult>& results, const std::string& id,
                      const std::string& title) {
  Table table{
      {"missing", "noise [%]", "paper: generations", "seeds that succeed [%]", "generations, median",
       "generations, 10 %", "generations, 90 %", "seeds at the minimum of Eq. 1 [%]", "against the paper"},
      {}};
  for (const CaseResult& result : results) {
    const int trials = result.paper_objective.trials;
    table.rows.push_back({as_printed(result.paper_case.scene), noise_per_cent(result.paper_case.noise),
                          paper_result(result.paper_case), kPerCent * share(result.genetic_found, trials),
                          quantile(result.generations, 0.5), quantile(result.generations, 0.1),
                          quantile(result.generations, 0.9), kPerCent * share(result.genetic_minimum, trials),
                          comparison(result)});
  }
  return {
      {id, title,
       fmt::format(
           "{} seeds a case. A seed succeeds if the genetic search ends at the true blocks; a case counts "
           "as found if half of its seeds succeed. Where the search reaches the minimum of Eq. 1 and "
           "that is not the truth, no search by Eq. 1 can find it.",
           subject.settings.trials),
       "", table, true, TableView::open}};
}

Exhibit posterior_exhibit(const std::vector<CaseResult>& results, const std::string& id,
                          const std::string& title) {
  Table table{{"missing", "noise [%]", "Eq. 1: first [%]", "Eq. 1: in five [%]", "known: first [%]",
               "known: in five [%]", "known: in the 95 % set [%]", "unknown: first [%]",
               "unknown: in five [%]", "unknown: in the 95 % set [%]"},
              {}};
  for (const CaseResult& r : results) {
    std::vector<TableCell> row = {as_printed(r.paper_case.scene), noise_per_cent(r.paper_case.noise)};
    const auto add = [&](int count) { row.emplace_back(kPerCent * share(count, r.paper_objective.trials)); };
    add(r.paper_objective.first);
    add(r.paper_objective.in_five);
    for (const Success& success : {r.right_model, r.default_model}) {
      add(success.first);
      add(success.in_five);
      add(success.in_credible);
    }
    table.rows.push_back(row);
  }
  return {{id, title,
           "Every scene with as many missing blocks is scored: by Eq. 1, by its posterior probability when "
           "shape and "
           "level of the noise are known, and when nothing of it is known (unknown).",
           "", table, true, TableView::open}};
}

}  // namespace voussoir
