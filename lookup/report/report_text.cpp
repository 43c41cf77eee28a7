#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/units.h"
#include "database/records/content_digest.h"
#include "lookup/answer/expected_readings.h"
#include "lookup/answer/verdict.h"
#include "lookup/checks/fewer_readings.h"
#include "lookup/readings/shown_readings.h"
#include "lookup/report/bridge_report.h"
#include "lookup/report/reading_words.h"
#include "lookup/report/report.h"
#include "lookup/report/report_words.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostBlocksListed = 5;
constexpr std::size_t kMostMovementsListed = 5;
constexpr double kBlockWorthListing = 0.01;
constexpr std::size_t kMostJointsListed = 3;
constexpr double kWorthSaying = 0.5;         // KnownParameter::news
constexpr double kShownAsNegative = -0.005;  // a share below it rounds to a whole per cent below zero

/// Collects lines.
class Text {
 public:
  template <typename... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void write_heading(Text& text, const Answer& answer, const Comparison& comparison, const Source& source) {
  text.line("Measurements: {}, {}", source.measurements, readings_in_words(comparison, answer.readings));
  text.line("Database:     {} (bridge '{}', digest {})", source.database, source.bridge,
            source.digest.substr(0, kDigestShown));
  for (std::size_t i = 0; i < source.databases.size(); ++i)
    text.line("{:<13} {}", i == 0 ? "Databases:" : "", in_words(source.databases[i]));
  text.line("Searched:     {}", searched_in_words(answer));
  text.line("History:      {}", history_in_words(comparison.history));
  text.line("Bridge:       {}", bridge_in_words(answer));
  if (source.stands_by_slip) text.line("              {}", kStandsBySlip);
  if (answer.bridge) text.line("Evidence:     {}", evidence_in_words(comparison));
  for (const std::string& note : source.notes) text.line("Note:         {}", note);
}

void write_verdict(Text& text, const Answer& answer, const Library& library) {
  if (answer.posterior) text.line("Verdict:      {}", verdict_in_words(answer));
  for (const std::string& sentence : conclusions_in_words(answer, library)) text.line("{}", sentence);
}

void write_table(Text& text, const Answer& answer, const Library& library) {
  std::size_t width = 5;
  for (const Candidate& candidate : answer.candidates)
    width = std::max(width, to_string(candidate.scene, library.layout).size());
  text.line("{:>4}  {:<{}}  {:>11}  {:>10}  {:>11}  {}", "rank", "scene", width, "probability", "misfit",
            "behind", "where");
  for (std::size_t i = 0; i < answer.candidates.size(); ++i) {
    const Candidate& candidate = answer.candidates[i];
    text.line("{:>4}  {:<{}}  {:>11}  {:>10.4f}  {:>11}  {}", i + 1,
              to_string(candidate.scene, library.layout), width,
              candidate.posterior ? percent(*candidate.posterior) : "-", candidate.misfit,
              i == 0 ? "-" : behind(candidate, answer.candidates.front()),
              place_in_words(candidate.scene, library.layout));
  }
}

void write_groups(Text& text, const Answer& answer, const Library& library) {
  const Candidate& best = answer.candidates.front();
  const std::string names = same_in_words(best, library);
  if (names.empty()) return;
  text.line("These sensors cannot tell {} from: {}", to_string(best.scene, library.layout), names);
}

void write_probabilities(Text& text, const Answer& answer, const Library& library) {
  const Posterior& posterior = *answer.posterior;
  text.line("Number of missing blocks{}: {}", if_true(answer), missing_in_words(answer));
  std::vector<BlockId> blocks = likely_blocks(posterior, kBlockWorthListing);
  blocks.resize(std::min(blocks.size(), kMostBlocksListed));
  std::string names;
  for (const BlockId id : blocks)
    names += fmt::format("{}{}: {}", names.empty() ? "" : "; ", library.layout[id].label,
                         percent(posterior.block_probability[static_cast<std::size_t>(value(id))]));
  text.line("Blocks most likely missing{}: {}", if_true(answer), names.empty() ? "none" : names);
  text.line("{:.0f} % of the probability is held by {} scene{}", 100.0 * kCredibleShare,
            posterior.credible.size(), posterior.credible.size() == 1 ? "" : "s");
}

std::string in_millimetres(double metres) {
  return std::isnan(metres) ? "-" : fmt::format("{:.3f}", kMillimetres * metres);
}

/// The largest readings of what is a difference, beside what the answer lets expect there; of a bridge that
/// is not exactly known with what the first candidate would show were it as the bridge file says.
void write_movements(Text& text, const Answer& answer, const Comparison& comparison) {
  if (comparison.kind == ReadingKind::absolute) return;
  const ShownReadings shown = shown_readings(comparison, answer.candidates.front().row);
  std::vector<std::size_t> channels;
  const std::vector<double> expected = expected_readings(answer, comparison);
  for (std::size_t i = 0; i < shown.reading.size(); ++i)
    if (!std::isnan(shown.reading[i])) channels.push_back(i);
  std::stable_sort(channels.begin(), channels.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(shown.reading[a]) > std::abs(shown.reading[b]);
  });
  channels.resize(std::min(channels.size(), kMostMovementsListed));
  const bool epochs = !comparison.before.empty();
  text.line("Moved most: {} [mm, tilts mm per m]", value_in_words(comparison.kind));
  text.line("      {:<20}{}  {:>9}  {:>9}{}", "point", epochs ? "     before       after" : "", "reading",
            "expected", answer.bridge ? "      by the file" : "");
  for (const std::size_t i : channels)
    text.line("      {:<20}{}  {:>9}  {:>9}{}", comparison.library.points[i].name,
              epochs ? fmt::format("{:>11} {:>11}", in_millimetres(comparison.before[i]),
                                   in_millimetres(comparison.after[i]))
                     : "",
              in_millimetres(shown.reading[i]), in_millimetres(expected[i]),
              answer.bridge ? fmt::format("  {:>15}", in_millimetres(shown.expected[i])) : "");
  text.line("");
}

void write_sensors(Text& text, const Answer& answer, const Comparison& comparison) {
  const std::vector<std::string> odd = odd_sensors(answer, comparison);
  if (odd.empty() && are_sensors_judged(answer)) text.line("Sensors: none disagrees with the rest");
  for (const std::string& sentence : odd) text.line("{}", sentence);
}

/// What else moved the sensors, and what the readings say of the bridge. Nothing if no scene explains them:
/// what is likeliest then may be any number.
void write_bridge(Text& text, const Answer& answer, const Comparison& comparison) {
  if (!answer.bridge || !has_probabilities(answer)) return;
  const ReadingFactors& factors = *comparison.factors;
  const std::vector<Cause> causes = causes_of(*answer.bridge, factors);
  const bool some_against =
      std::ranges::any_of(causes, [](const Cause& one) { return one.share < kShownAsNegative; });
  text.line("Explained by: {}{}", causes_in_words(causes),
            some_against ? " (below zero: works against the rest)" : "");
  for (const KnownParameter& parameter : known_of_epochs(*answer.bridge, factors))
    if (parameter.news() > kWorthSaying) text.line("      {}", in_words(parameter));
  std::vector<KnownParameter> bridge = known_of_bridge(*answer.bridge, factors, kMostJointsListed);
  std::erase_if(bridge, [](const auto& parameter) { return parameter.news() <= kWorthSaying; });
  if (!bridge.empty()) text.line("The readings say of the bridge itself:");
  for (const KnownParameter& parameter : bridge) text.line("      {}", in_words(parameter));
}

void write_genetic(Text& text, const Answer& answer) {
  for (const GeneticResult& run : answer.genetic)
    text.line("Genetic search: {} generations, the best appeared in generation {}, {} scenes scored",
              run.generations, run.converged, run.evaluations);
}

}  // namespace

std::string text_report(const Answer& answer, const Comparison& comparison, const Source& source) {
  const Library& library = comparison.library;
  Text text;
  if (const std::string first = headline(answer, comparison); !first.empty()) text.line("{}", first);
  if (const std::string other = without_in_words(answer, comparison); !other.empty()) text.line("{}", other);
  if (answer.posterior) text.line("");
  write_heading(text, answer, comparison, source);
  write_genetic(text, answer);
  text.line("");
  if (answer.candidates.empty()) {
    text.line(
        "No scene in this database explains these measurements: every scene lacks a block that has a "
        "reading.");
    return text.take();
  }
  write_verdict(text, answer, library);
  if (answer.noise) text.line("Noise:        {}", noise_in_words(*answer.noise, comparison));
  text.line("");
  write_table(text, answer, library);
  text.line("");
  write_movements(text, answer, comparison);
  write_groups(text, answer, library);
  if (answer.posterior && !answer.posterior->credible.empty()) write_probabilities(text, answer, library);
  write_bridge(text, answer, comparison);
  if (answer.posterior) write_sensors(text, answer, comparison);
  return text.take();
}

}  // namespace voussoir
