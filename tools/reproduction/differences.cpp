#include "tools/reproduction/differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bridge_file/bridge_file.h"
#include "tools/reproduction/exhibits.h"

namespace voussoir {
namespace {

/// Smallest and largest settlement [mm] of some points.
struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
};

Extent extent_of(const Subject& subject, bool arch) {
  const std::vector<double> mm = subject.settlements_mm(subject.row(subject.cases.example.scene));
  Extent extent;
  for (std::size_t i = 0; i < mm.size(); ++i) {
    const BlockId block = subject.database.control_points()[i].block;
    if ((subject.database.layout()[block].role == BlockRole::ring) != arch || std::isnan(mm[i])) continue;
    extent.least = std::min(extent.least, std::abs(mm[i]));
    extent.most = std::max(extent.most, std::abs(mm[i]));
  }
  return extent;
}

void add_displacements(const Subject& subject, Table& table) {
  if (!subject.cases.top_mm || !subject.cases.arch_mm) return;
  const Extent top = extent_of(subject, false);
  const Extent arch = extent_of(subject, true);
  table.rows.push_back({"Size of the displacements, Fig. 4",
                        fmt::format("top {:g} to {:g} mm, arch {:g} to {:g} mm",
                                    subject.cases.top_mm->front(), subject.cases.top_mm->back(),
                                    subject.cases.arch_mm->front(), subject.cases.arch_mm->back()),
                        fmt::format("top {:.2g} to {:.2g} mm, arch {:.2g} to {:.2g} mm", top.least, top.most,
                                    arch.least, arch.most),
                        "The paper's penalties p_n and p_t are read as joint stiffness per unit area; "
                        "displacements are almost exactly "
                        "proportional to 1/p_n, so softer joints give the same pattern on a larger scale. "
                        "Noise is relative, so what can "
                        "be found does not change."});
}

void add_geometry(const Subject& subject, Table& table) {
  const BridgeDescription bridge =
      parse_bridge_file(subject.database.bridge_text(), subject.database.bridge_name()).description;
  if (subject.cases.radius_m && !bridge.spans.empty())
    table.rows.push_back(
        {"Radius of the arch", fmt::format("R = {:g} m", *subject.cases.radius_m),
         fmt::format("clear span {:g} m, intrados radius {:g} m", 2.0 * bridge.spans.front().intrados_radius,
                     bridge.spans.front().intrados_radius),
         fmt::format(
             "Read as the clear span it gives {} blocks and {} control points, as the paper counts them, and "
             "puts every block that the paper describes where it says.",
             subject.database.layout().size(), subject.database.control_points().size())});
  if (subject.cases.triangles)
    table.rows.push_back(
        {"Triangles", fmt::format("{}", *subject.cases.triangles),
         fmt::format("{} in the database", subject.database.mesh().triangles.size()),
         "Blocks are cut by one rule, then edges are split where a neighbour's corner touches them, "
         "which makes the change that a removal causes more accurate."});
}

void add_collapses(const Subject& subject, Table& table) {
  std::string outcomes;
  bool all_stand = true;
  for (const std::string& scene : subject.cases.local_collapse) {
    const std::string words = outcome_in_words(subject, scene);
    outcomes += fmt::format("{}{} {}", outcomes.empty() ? "" : ", ", as_printed(scene), words);
    all_stand = all_stand && words == "stands";
  }
  if (outcomes.empty()) return;
  table.rows.push_back(
      {"Local collapse", subject.cases.collapse_in_paper, outcomes,
       all_stand ? "Gravity grows slowly here, and the blocks above the gap hang on their neighbours by "
                   "friction. If gravity acts suddenly they can slide down."
                 : "What falls and what hangs by friction depends on how gravity is applied."});
}

/// Sum over the control points [mm] of what the second row changes against the first, where both have values.
double change(const Subject& subject, std::size_t from, std::size_t to) {
  const std::vector<double> a = subject.settlements_mm(from), b = subject.settlements_mm(to);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!std::isnan(a[i]) && !std::isnan(b[i])) sum += std::abs(b[i] - a[i]);
  return sum;
}

/// What a second missing block changes beside an arch block, and alone.
void add_masking(const Subject& subject, Table& table) {
  const auto pair = std::find_if(subject.cases.two_blocks.begin(), subject.cases.two_blocks.end(),
                                 [](const PaperCase& one) { return one.scene.starts_with("0,"); });
  if (pair == subject.cases.two_blocks.end()) return;
  const std::size_t plus = pair->scene.find('+');
  const std::string arch = pair->scene.substr(0, plus), other = pair->scene.substr(plus + 1);
  table.rows.push_back(
      {"A second block beside an arch block", "cannot be found",
       fmt::format("{} alone changes the control points by {:.3g} mm in all, beside {} by {:.3g} mm",
                   as_printed(other), change(subject, 0, subject.row(other)), as_printed(arch),
                   change(subject, subject.row(arch), subject.row(pair->scene))),
       "Fields of collapses are taken early in the fall here, before movements are large, and the fall with "
       "the second "
       "block missing is another one."});
}

void add_noise_limit(const Subject& subject, const std::vector<GenerationsAtNoise>& runs, Table& table) {
  std::string shares;
  for (const double level : subject.cases.noise_limit_levels)
    for (const GenerationsAtNoise& run : runs)
      if (noise_per_cent(run.noise) == noise_per_cent(level))
        shares +=
            fmt::format("{}at {:g} % {} of {} seeds{}", shares.empty() ? "" : "; ", noise_per_cent(level),
                        run.generations.size(), run.seeds,
                        run.generations.empty() ? ""
                                                : fmt::format(", after {} generations in the middle",
                                                              run.generations[run.generations.size() / 2]));
  if (shares.empty()) return;
  table.rows.push_back({"Noise that the search bears", subject.cases.noise_limit_in_paper,
                        "seeds that end at the truth: " + shares,
                        "Fifty members see most of the single scenes within a few generations, whatever the "
                        "noise, so the minimum of "
                        "Eq. 1 is found soon; noise decides whether that minimum is the truth."});
}

void add_search(Table& table) {
  table.rows.push_back({"Genetic search",
                        "population 50, crossover 0.8, mutation 0.7; each candidate is simulated",
                        "the same settings; each candidate is looked up in the database",
                        "The paper does not say how parents are chosen, what a mutation does or when a run "
                        "ends. Here parents win "
                        "tournaments of two, half of the mutations move a block by one or two places and the "
                        "others anywhere, the best "
                        "member survives, and every run has its full number of generations. So counts of "
                        "generations compare in order of "
                        "size only."});
}

void add_cases(const std::vector<CaseResult>& results, const std::string& name, Table& table) {
  std::string differing;
  std::size_t tried = 0, differ = 0;
  for (const CaseResult& result : results) {
    if (result.paper_case.paper.empty()) continue;
    ++tried;
    if ((result.paper_case.paper.find('-') == std::string::npos) == found(result)) continue;
    ++differ;
    differing += fmt::format("{}{} at {:.0f} %: {}", differing.empty() ? "" : "; ",
                             as_printed(result.paper_case.scene), 100.0 * result.paper_case.noise,
                             found(result) ? "found here" : "not found here");
  }
  if (tried == 0) return;
  table.rows.push_back(
      {name + ", found or not", fmt::format("{} cases", tried),
       differ == 0 ? "all agree" : fmt::format("{} differ: {}", differ, differing),
       "The paper shows one run a case; here a case counts as found if half of the seeds succeed, and "
       "where Eq. 1 is smallest elsewhere than at the truth no search succeeds."});
}

}  // namespace

Table differences(const Subject& subject, const std::vector<CaseResult>& one_block,
                  const std::vector<CaseResult>& two_blocks,
                  const std::vector<GenerationsAtNoise>& generations) {
  Table table{{"topic", "paper", "here", "why"}, {}};
  add_displacements(subject, table);
  add_geometry(subject, table);
  add_collapses(subject, table);
  add_masking(subject, table);
  add_noise_limit(subject, generations, table);
  add_search(table);
  add_cases(one_block, "Table 2", table);
  add_cases(two_blocks, "Table 3", table);
  return table;
}

}  // namespace voussoir
