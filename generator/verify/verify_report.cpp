#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/json_text.h"
#include "generator/verify/verify.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostProblems = 20;  ///< problems in the text; JSON has them all

std::string problem_text(const std::vector<std::string>& problems) {
  if (problems.empty()) return "  no problems\n";
  std::string text = fmt::format("  {} problem{}:\n", problems.size(), problems.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(problems.size(), kMostProblems); ++i)
    text += "    " + problems[i] + "\n";
  if (problems.size() > kMostProblems)
    text += fmt::format("    and {} more\n", problems.size() - kMostProblems);
  return text;
}

}  // namespace

std::string to_text(const VerifyReport& report, const std::filesystem::path& database) {
  const std::string extent =
      report.part ? fmt::format("part {} of a database", to_string(*report.part)) : "whole";
  std::string text =
      fmt::format("{}: {}\n", database.string(), report.ok() ? extent + " and consistent" : "NOT in order");
  text += fmt::format("  digest      {}\n", report.digest);
  text += fmt::format("  scenes      {}\n", report.outcomes.scenes) + to_text(report.outcomes);
  text += fmt::format(
      "  fields      {} checked, largest unbalanced force {:.1e} of a weight (up to {:.1e} is round-off)\n",
      report.fields, report.largest_unbalance, report.most_unbalance);
  text += collapses_text(report.collapse_fields);
  text += fmt::format("  mirrored    {} pairs compared\n", report.mirror_pairs);
  if (report.recomputed > 0)
    text += fmt::format("  recomputed  {} scenes, largest difference {:.1e} m\n", report.recomputed,
                        report.largest_recomputed_difference);
  if (report.recomputed_composed > 0)
    text += fmt::format("  composed    {} of these, off by at most {:.2f} of what is allowed\n",
                        report.recomputed_composed, report.largest_composed_error);
  if (report.recomputed_inherited > 0)
    text += fmt::format("  inherited   {} of these\n", report.recomputed_inherited);
  return text + problem_text(report.problems);
}

std::string to_json(const VerifyReport& report) {
  nlohmann::ordered_json json = {{"ok", report.ok()}, {"digest", report.digest}};
  json["part"] = report.part ? nlohmann::ordered_json(to_string(*report.part)) : nlohmann::ordered_json();
  json.update(to_json(report.outcomes));
  json.update({{"collapses", report.collapse_fields ? "field" : "outcome"},
               {"fields", report.fields},
               {"largest_unbalance", report.largest_unbalance},
               {"most_unbalance", report.most_unbalance},
               {"mirror_pairs", report.mirror_pairs},
               {"recomputed", report.recomputed},
               {"largest_recomputed_difference_m", report.largest_recomputed_difference},
               {"recomputed_composed", report.recomputed_composed},
               {"largest_composed_error", report.largest_composed_error},
               {"recomputed_inherited", report.recomputed_inherited},
               {"problems", report.problems}});
  return json_text(json);
}

}  // namespace voussoir
