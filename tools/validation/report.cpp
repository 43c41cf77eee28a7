#include "tools/validation/report.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

namespace voussoir::validation {
namespace {

std::string optional_number(const std::optional<double>& number) {
  return number ? fmt::format("{:.2g}", *number) : "-";
}

void add_case(const Case& c, std::string& text) {
  text += fmt::format("  {}\n    {}\n", c.name, c.quantity);
  text += fmt::format("    expected {:.6g} ({})\n", c.expected, c.source);
  text += fmt::format("    computed {:.6g}, error {:.2g}, tolerance {}: {}\n", c.computed, c.error,
                      optional_number(c.tolerance), mark(c));
  text += fmt::format("    why: {}\n", c.reason);
}

void add_hard_case(const HardCase& c, std::string& text) {
  text += fmt::format("  {:<26} {:<24} {:<10} {:<11} {:>8} {:>6}  {:<8} {}\n", c.sweep, c.setting, c.scene,
                      c.verdict, optional_number(c.error), c.iterations, mark(c), c.expected);
}

nlohmann::json number_or_null(const std::optional<double>& number) {
  return number ? nlohmann::json(*number) : nlohmann::json();
}

nlohmann::json json_of(const Case& c) {
  return {{"name", c.name},         {"quantity", c.quantity},
          {"expected", c.expected}, {"source", c.source},
          {"computed", c.computed}, {"error", c.error},
          {"reason", c.reason},     {"tolerance", number_or_null(c.tolerance)},
          {"mark", mark(c)}};
}

nlohmann::json json_of(const HardCase& c) {
  return {{"sweep", c.sweep},     {"setting", c.setting},      {"scene", c.scene},
          {"verdict", c.verdict}, {"expected", c.expected},    {"error", number_or_null(c.error)},
          {"correct", c.correct}, {"iterations", c.iterations}};
}

}  // namespace

std::string mark(const Case& known) {
  if (!known.tolerance) return "comparison";
  return known.within() ? "within" : "OUTSIDE";
}

std::string mark(const HardCase& hard) {
  return hard.correct ? "correct" : "WRONG";
}

std::string to_sentence(const Tally& t) {
  std::string text =
      fmt::format("{} of {} known answers within tolerance, {} comparisons, {} of {} hard cases correct",
                  t.within, t.cases, t.comparisons, t.correct, t.hard_cases);
  if (t.failures > 0) text += fmt::format(", {} studies failed to run", t.failures);
  return text;
}

std::string to_text(const std::vector<StudyResult>& results) {
  std::string text;
  for (const StudyResult& result : results) {
    text += fmt::format("{} [{}, {:.1f} s]\n", result.title, result.name, result.seconds);
    if (!result.failure.empty()) text += fmt::format("  FAILED: {}\n", result.failure);
    for (const Case& c : result.findings.cases) add_case(c, text);
    for (const HardCase& c : result.findings.hard_cases) add_hard_case(c, text);
    for (const std::string& note : result.findings.notes) text += fmt::format("  Note: {}\n", note);
    text += '\n';
  }
  return text + to_sentence(tally(results)) + '\n';
}

std::string to_markdown(const std::vector<StudyResult>& results) {
  std::string text =
      "| case | quantity | expected | computed | error | tolerance |\n|---|---|---|---|---|---|\n";
  std::map<std::string, std::pair<int, int>> sweeps;  // correct, all
  for (const StudyResult& result : results) {
    for (const Case& c : result.findings.cases)
      text +=
          fmt::format("| {} | {} | {:.5g} | {:.5g} | {:.1e} | {} |\n", c.name, c.quantity, c.expected,
                      c.computed, c.error, c.tolerance ? fmt::format("{:.1e}", *c.tolerance) : "compared");
    for (const HardCase& c : result.findings.hard_cases) {
      sweeps[c.sweep].first += c.correct;
      ++sweeps[c.sweep].second;
    }
  }
  text += "\n| hard cases | correct |\n|---|---|\n";
  for (const auto& [sweep, count] : sweeps)
    text += fmt::format("| {} | {} of {} |\n", sweep, count.first, count.second);
  return text + '\n' + to_sentence(tally(results)) + "\n";
}

std::string to_json(const std::vector<StudyResult>& results) {
  nlohmann::json json = {{"ok", tally(results).all_good()},
                         {"cases", nlohmann::json::array()},
                         {"hard_cases", nlohmann::json::array()},
                         {"notes", nlohmann::json::array()},
                         {"studies", nlohmann::json::array()}};
  for (const StudyResult& result : results) {
    for (const Case& c : result.findings.cases) json["cases"].push_back(json_of(c));
    for (const HardCase& c : result.findings.hard_cases) json["hard_cases"].push_back(json_of(c));
    for (const std::string& note : result.findings.notes) json["notes"].push_back(note);
    json["studies"].push_back(
        {{"name", result.name}, {"seconds", result.seconds}, {"failure", result.failure}});
  }
  return json.dump(2) + '\n';
}

}  // namespace voussoir::validation
