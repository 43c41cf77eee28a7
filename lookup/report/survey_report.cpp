#include "lookup/report/survey_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/not_a_number.h"
#include "lookup/answer/verdict.h"
#include "lookup/report/drawing/table.h"
#include "lookup/report/report_words.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

Table table_of(const std::vector<SurveyRow>& rows) {
  Table table{{"file", "verdict", "named", "certainty", "scene", "posterior", "intact_probability", "misfit",
               "readings", "reason", "error", "suspects", "verdict_without", "named_without", "open_losses",
               "open_losses_without"},
              {}};
  const bool several = std::ranges::any_of(rows, [](const SurveyRow& row) { return !row.database.empty(); });
  if (several) table.columns.push_back("database");
  for (const SurveyRow& row : rows) {
    const bool answered = row.error.empty();
    table.rows.push_back({row.file, row.verdict, row.named, answered ? row.certainty : kNan, row.scene,
                          answered ? row.posterior : kNan, answered ? row.intact_probability : kNan,
                          answered ? row.misfit : kNan, answered ? static_cast<double>(row.readings) : kNan,
                          row.reason, row.error, row.suspects, row.verdict_without, row.named_without,
                          answered ? static_cast<double>(row.open_losses) : kNan,
                          row.suspects.empty() ? kNan : static_cast<double>(row.open_losses_without)});
    if (several) table.rows.back().push_back(row.database);
  }
  return table;
}

/// What goes with `intact`.
std::string not_excluded(std::size_t losses) {
  if (losses == 0) return "";
  return fmt::format(", but {} {} not excluded", losses, losses == 1 ? "loss is" : "losses are");
}

std::string line_of(const SurveyRow& row) {
  if (!row.error.empty()) return fmt::format("{}: no answer: {}\n", row.file, row.error);
  if (row.scene.empty()) return fmt::format("{}: {}; no scene is possible\n", row.file, row.verdict);
  if (std::isnan(row.posterior)) return fmt::format("{}: smallest misfit {}\n", row.file, row.scene);
  const std::string named =
      row.named.empty() ? "" : fmt::format(" {} ({})", row.named, percent(row.certainty));
  std::string reason = row.reason.empty() ? "" : fmt::format(" ({})", row.reason);
  if (!row.suspects.empty())
    reason += fmt::format(", without {} {}{}{}{}", row.suspects, row.verdict_without,
                          row.named_without.empty() ? "" : " ", row.named_without,
                          not_excluded(row.open_losses_without));
  reason += not_excluded(row.open_losses);
  return fmt::format("{}: {}{}{}; first {} ({}), intact {}{}\n", row.file, row.verdict, named, reason,
                     row.scene, percent(row.posterior), percent(row.intact_probability),
                     row.database.empty() ? "" : fmt::format("; {}", row.database));
}

std::string named_in_words(const Answer& answer, const BlockLayout& layout) {
  std::string named;
  for (const BlockId block : named_blocks(answer)) named += (named.empty() ? "" : "+") + layout[block].label;
  return named;
}

void add_without(const Answer& answer, const Comparison& comparison, SurveyRow& row) {
  if (!answer.without) return;
  const Answer& other = *answer.without->answer;
  row.suspects = fmt::format("{}", fmt::join(suspects_in_words(answer, comparison), ", "));
  row.verdict_without = to_string(verdict_of(other));
  row.named_without = named_in_words(other, comparison.library.layout);
  row.open_losses_without = open_losses(other).size();
}

}  // namespace

SurveyRow survey_row(const std::string& file, const Answer& answer, const Comparison& comparison,
                     const std::string& database) {
  SurveyRow row{.file = file,
                .error = {},
                .certainty = kNan,
                .posterior = kNan,
                .intact_probability = kNan,
                .misfit = kNan};
  row.database = database;
  row.readings = answer.readings;
  if (answer.posterior) {
    row.verdict = to_string(verdict_of(answer));
    row.intact_probability = intact_probability(*answer.posterior);
    if (answer.fit) row.reason = answer.fit->reason;
    row.named = named_in_words(answer, comparison.library.layout);
    if (!row.named.empty()) {
      const BlockId last = named_blocks(answer).back();
      row.certainty = answer.posterior->block_probability[static_cast<std::size_t>(value(last))];
    }
    row.open_losses = open_losses(answer).size();
    add_without(answer, comparison, row);
  }
  if (answer.candidates.empty()) return row;
  const Candidate& first = answer.candidates.front();
  row.scene = to_string(first.scene, comparison.library.layout);
  row.posterior = first.posterior.value_or(kNan);
  row.misfit = first.misfit;
  return row;
}

std::string survey_report(const std::vector<SurveyRow>& rows, ReportFormat format) {
  if (format == ReportFormat::json) return to_json(table_of(rows));
  if (format == ReportFormat::csv) return to_csv(table_of(rows));
  std::string text;
  for (const SurveyRow& row : rows) text += line_of(row);
  return text;
}

}  // namespace voussoir
