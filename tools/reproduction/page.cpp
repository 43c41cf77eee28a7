#include "tools/reproduction/page.h"

#include <fmt/format.h>

#include "core/text_file.h"
#include "tools/reproduction/differences.h"
#include "tools/reproduction/exhibits.h"
#include "tools/reproduction/findings.h"

namespace voussoir {
namespace {

/// What all noisy trials gave.
struct Results {
  std::vector<CaseResult> one_block, two_blocks;
  std::vector<GenerationsAtNoise> generations;
  std::vector<OperatingPoint> curve_one, curve_two;
  std::vector<CourseSuccess> courses;
  PairSuccess with_arch, without_arch;
};

Results run_experiments(const Subject& subject) {
  return {run_cases(subject, subject.cases.one_block),
          run_cases(subject, subject.cases.two_blocks),
          generations_against_noise(subject),
          operating_curve(subject, 1),
          operating_curve(subject, 2),
          success_by_course(subject),
          success_of_pairs(subject, true),
          success_of_pairs(subject, false)};
}

Exhibit table_only(const std::string& id, const std::string& title, const std::string& caption, Table table) {
  return {{id, title, caption, "", std::move(table), true, TableView::open}};
}

Chapter findings_chapter(const Subject& subject, const Results& results) {
  std::vector<Finding> findings = {arch_blocks_mask(results.with_arch, results.without_arch),
                                   high_blocks_are_easier(results.courses)};
  if (subject.cases.hard_pair) findings.push_back(pair_is_hard(*subject.cases.hard_pair, results.two_blocks));
  findings.push_back(noise_raises_generations(results.generations));
  Chapter chapter{"findings", "What holds and what does not", "", {}};
  chapter.exhibits.push_back(table_only(
      "findings-table", "The paper's findings in words",
      "A statement holds if the numbers differ in its direction by more than two standard errors; the "
      "statement about a "
      "pair, if fewer than half of the seeds find it and fewer than half of the other pairs are harder.",
      to_table(findings)));
  chapter.exhibits.push_back(
      table_only("differences", "Where this run differs from the paper, and why", "",
                 differences(subject, results.one_block, results.two_blocks, results.generations)));
  return chapter;
}

bool is_pair(const std::string& scene) {
  return scene.find('+') != std::string::npos;
}

Chapter chapter_of(const Subject& subject, const Results& results, bool pairs) {
  Chapter chapter{pairs ? "two" : "one", pairs ? "Two missing blocks" : "One missing block", "", {}};
  if (!pairs) {
    chapter.exhibits.push_back(example_exhibit(subject));
    chapter.exhibits.push_back(objective_exhibit(subject));
    chapter.exhibits.push_back(generations_exhibit(subject, results.generations));
  }
  chapter.exhibits.push_back(pairs ? table_exhibit(subject, results.two_blocks, "table-3", "Table 3")
                                   : table_exhibit(subject, results.one_block, "table-2", "Table 2"));
  for (const FieldCase& field : subject.cases.fields)
    if (is_pair(field.scene) == pairs) chapter.exhibits.push_back(field_exhibit(subject, field));
  return chapter;
}

Chapter beyond_chapter(const Results& results) {
  return {
      "beyond",
      "What the paper does not have",
      "",
      {posterior_exhibit(results.one_block, "table-2-posterior", "The cases of Table 2 by exact posterior"),
       posterior_exhibit(results.two_blocks, "table-3-posterior", "The cases of Table 3 by exact posterior"),
       operating_exhibit(results.curve_one, "operating-one", "Operating curves: one missing block"),
       operating_exhibit(results.curve_two, "operating-two", "Operating curves: two missing blocks"),
       course_exhibit(results.courses)}};
}

std::string source_html(const Subject& subject) {
  const Provenance provenance = subject.database.provenance();
  const auto& settings = subject.settings;
  return section_html(
      "made", "How this page was made",
      terms_html(
          {{"Database digest", subject.database.digest()},
           {"Bridge", subject.database.bridge_name()},
           {"Scenes", fmt::format("{}", subject.database.table().rows)},
           {"Program", fmt::format("version {}, {}", provenance.program_version, provenance.compiler)},
           {"Seeds", fmt::format("{} seeds a case from {}, {} random scenes a level", settings.trials,
                                 settings.seed, settings.random_scenes)},
           {"Numbers",
            "all from this run; the file of the same name as a figure's anchor (figure-6.csv) has them "
            "with all digits"}}));
}

}  // namespace

std::vector<Chapter> reproduce(const Subject& subject) {
  const Results results = run_experiments(subject);
  std::vector<Exhibit> model = geometry_exhibits(subject);
  if (!subject.settings.wall.empty())
    for (Exhibit& exhibit : wall_exhibits(run_wall_test(subject.settings.wall)))
      model.push_back(std::move(exhibit));
  return {findings_chapter(subject, results),
          {"model", "The model", "", std::move(model)},
          chapter_of(subject, results, false),
          chapter_of(subject, results, true),
          beyond_chapter(results)};
}

std::string reproduction_page(const Subject& subject, const std::vector<Chapter>& chapters) {
  std::string body = paragraph(fmt::format("Figures and tables of {}, from the database of bridge '{}'.",
                                           subject.cases.source, subject.database.bridge_name()),
                               "lead");
  for (const Chapter& chapter : chapters) {
    std::vector<Figure> figures;
    for (const Exhibit& exhibit : chapter.exhibits) figures.push_back(exhibit.figure);
    body += section_html(chapter.id, chapter.heading, chapter.text + figures_html(figures));
  }
  return html_page("Missing blocks of a masonry arch bridge: the paper reproduced",
                   body + source_html(subject));
}

void write_reproduction(const Subject& subject, const std::vector<Chapter>& chapters,
                        const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const Chapter& chapter : chapters)
    for (const Exhibit& exhibit : chapter.exhibits) {
      write_file(folder / (exhibit.figure.id + ".csv"), to_csv(exhibit.figure.table));
      for (const auto& [name, table] : exhibit.more) write_file(folder / (name + ".csv"), to_csv(table));
    }
  write_file(folder / "index.html", reproduction_page(subject, chapters));
}

}  // namespace voussoir
