#include "lookup/other_explanations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.h"
#include "core/units.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/gross_errors.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostFalls = 10;  // scenes near the readings, of which those that fall are looked at
constexpr std::array kTimesErrors = {3.0, 10.0, 100.0};  // errors that are asked about, of what is stated
constexpr std::size_t kMostLines = 4;                    // of levelling that may be off alike
constexpr std::size_t kMostLoads = 3;                    // stretches of the top that a load may stand on
constexpr double kNewtonsPerKilonewton = 1e3;
constexpr double kLeastForce = 10e3;     // [N/m] of a load that is spoken of where nothing explains readings
constexpr double kLoadChance = 1e-3;     // beforehand that one stood there and is not stated
constexpr std::size_t kMostHidden = 3;   // losses that only readings on their blocks exclude
constexpr std::size_t kMostLikely = 10;  // scenes that each of them competes with
// Beforehand that what was read on a block goes on giving a value when the block is lost: the block is loose
// and carries nothing, but hangs there; a logger repeats its last value; the target was on the one beside it.
constexpr double kKeptChance = 1e-2;

/// Do larger errors than those that are stated explain the readings far better, with no block missing or by
/// scenes that are near them? A scene that scatters much, if errors of 0.02 mm are said to be 0.002, seems
/// to.
std::optional<Fit> check_stated_errors(const QuestionContext& asked, const Answer& answer,
                                       const Alarm& alarm) {
  for (const double times : kTimesErrors) {
    const double log = log_sum_of(asked.question.log_parts_of(alarm.rows, asked.preparation.eligible(),
                                                              answer.prior, {.errors = times}));
    if (log > answer.posterior->log_evidence - std::log(kSmallestChance))
      return Fit{false, answer.fit->chance,
                 fmt::format("errors {:g} times as large as stated explain them far better", times)};
  }
  return std::nullopt;
}

/// What falls may come to lie anywhere, so little of its probability is near any readings. Would falls be
/// likely, too, if they showed just what the database has of them, and the best of them is not?
std::optional<Fit> check_falls(const QuestionContext& asked, const Answer& answer) {
  const UnknownBridge& bridge = asked.question.bridge();
  const SceneTable& table = asked.comparison.library.table;
  std::vector<std::size_t> rows = rows_near(asked, asked.observation, kMostFalls);
  std::erase_if(rows, [&](std::size_t row) { return known_losses(bridge, table, row).all; });
  if (rows.empty()) return std::nullopt;
  const std::vector<double> logs =
      asked.question.log_parts_of(rows, asked.preparation.eligible(), answer.prior, {.shown_exactly = true});
  const std::size_t best = rows[static_cast<std::size_t>(std::ranges::max_element(logs) - logs.begin())];
  const auto& likely = answer.posterior->credible;
  if (!is_likely_beside(answer, log_sum_of(logs)) || std::ranges::find(likely, best) != likely.end())
    return std::nullopt;
  return Fit{false, answer.fit->chance,
             fmt::format("what falls without {} would show them, too",
                         to_string(table.scene(best), asked.comparison.library.layout))};
}

/// The readings without what a cause most likely adds to them with no block missing.
Observation without(const UnknownBridge& bridge, Observation observation, const UnstatedCause& cause) {
  for (std::size_t k = 0; k < bridge.rows.size(); ++k) {
    const auto& [channel, before, after] = bridge.rows[k];
    if (after == 0.0) continue;
    observation.displacement[channel] -= cause.expected[static_cast<Eigen::Index>(k)];
    observation.reading[channel] -= cause.expected[static_cast<Eigen::Index>(k)];
  }
  return observation;
}

/// To one digit: forces are known to a factor of two.
double to_one_digit(double value) {
  if (value == 0.0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return unit * std::round(value / unit);
}

std::string_view at_time(ReadingKind kind, bool first_epoch) {
  if (!is_change(kind)) return "";
  return first_epoch ? " at the first of the two times" : " at the second of the two times";
}

/// "a load of about 50 kN for each metre of the bridge's width between x = 8 and 16 m at the second of the
/// two times"
std::string in_words(const UnstatedLoad& load, ReadingKind kind) {
  return fmt::format(
      "a load of about {:g} kN for each metre of the bridge's width between x = {:.3g} and {:.3g} m{}",
      to_one_digit(load.force / kNewtonsPerKilonewton), load.from, load.to, at_time(kind, load.first_epoch));
}

/// "an error of about 0.3 mm that all readings at A1 to A38 share (a datum, tilt or set-up of their own, ..)"
std::string in_words(const LineError& line, const QuestionContext& asked) {
  const Comparison& comparison = asked.comparison;
  std::vector<std::string> names;
  for (const std::size_t channel : line.channels) names.push_back(name_without_load(comparison, channel));
  const bool both_count = asked.question.bridge().has_first_epoch();
  return fmt::format(
      "an error of about {:g} mm that all readings at {}{}{} share (a datum, tilt or set-up of their own, "
      "which a column levelling with --unknown-datum and --unknown-tilt would state)",
      to_one_digit(kMillimetres * line.size), names_in_words(names),
      under_load(load_of(comparison, line.channels.front())),
      both_count ? at_time(comparison.kind, line.first_epoch) : "");
}

/// If something acted that nobody stated, would others be likely?
std::optional<Fit> check_cause(const QuestionContext& asked, const Answer& answer, const Alarm& alarm,
                               const UnstatedCause& cause, double chance, const std::string& in_words) {
  const auto scene = explained_by(
      asked, answer, alarm,
      {{.beside = cause.covariance}, chance, without(asked.question.bridge(), asked.observation, cause)});
  if (!scene) return std::nullopt;
  const std::string named =
      alarm.named.empty() ? "some block" : to_string(Scene{alarm.named}, asked.comparison.library.layout);
  return Fit{false, answer.fit->chance,
             fmt::format("{} may be behind them: with it {} would be likely, without it {} is missing",
                         in_words, scene_in_words(asked, *scene), named)};
}

std::optional<Fit> check_unstated_causes(const QuestionContext& asked, const Answer& answer,
                                         const Alarm& alarm) {
  for (const LineError& line : asked.question.line_errors(kMostLines))
    if (const auto fit = check_cause(asked, answer, alarm, line.cause, line.chance, in_words(line, asked)))
      return fit;
  for (const UnstatedLoad& load : asked.question.unstated_loads(kMostLoads))
    if (const auto fit =
            check_cause(asked, answer, alarm, load.cause, kLoadChance, in_words(load, asked.comparison.kind)))
      return fit;
  return std::nullopt;
}

/// What a hidden loss competes with, and the scenes with it: alone and beside what the answer calls missing.
std::vector<std::size_t> rows_with_hidden(const QuestionContext& asked, const Answer& answer,
                                          const Observation& others, BlockId block) {
  const SceneTable& table = asked.comparison.library.table;
  const Eligible& eligible = asked.preparation.eligible();
  const std::vector<std::size_t>& likely = answer.posterior->credible;
  std::vector<std::size_t> rows = rows_near(asked, others, kMostNear);
  rows.insert(rows.end(), likely.begin(),
              likely.begin() + static_cast<std::ptrdiff_t>(std::min(likely.size(), kMostLikely)));
  if (eligible.missing.front() == 0) rows.push_back(eligible.rows.front());
  const Scene called = table.scene(likely.front());
  std::vector<Scene> scenes = {{{block}}, called};
  for (const BlockId missing : called.removed) scenes.push_back({{missing}});
  for (Scene& scene : scenes) {
    if (!scene.lacks(block)) scene.removed.push_back(block);
    std::ranges::sort(scene.removed);
    const auto row = table.find(scene);
    if (row && std::ranges::binary_search(eligible.rows, *row)) rows.push_back(*row);
  }
  return distinct(std::move(rows));
}

/// A block that is read is not missing, unless what is read is on it no longer. Would its loss, alone or with
/// others, explain all other readings better than what the answer calls likely?
bool would_be_lost(const QuestionContext& asked, const Answer& answer, const HiddenLoss& hidden) {
  const SceneTable& table = asked.comparison.library.table;
  const BlockId block = table.scene(hidden.row).removed.front();
  const Observation others = without(asked.observation, hidden.channels);
  const std::vector<std::size_t> rows = rows_with_hidden(asked, answer, others, block);
  UnknownBridgeQuestion question(asked.comparison, others, asked.settings);
  const std::vector<double> logs =
      question.log_parts_of(rows, asked.preparation.eligible(), answer.prior, {});
  double lost = kImpossible, there = kImpossible;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double& sum = table.scene(rows[i]).lacks(block) ? lost : there;
    sum = log_sum(sum, logs[i]);
  }
  return is_likely_beside(there, std::log(kKeptChance) + lost);
}

std::optional<Fit> check_hidden_losses(const QuestionContext& asked, const Answer& answer) {
  const Library& library = asked.comparison.library;
  const std::vector<double> prior =
      log_prior_by_missing(library.table, asked.preparation.eligible(), answer.prior);
  std::vector<HiddenLoss> hidden = asked.question.hidden_losses(asked.preparation.eligible());
  hidden.resize(std::min(hidden.size(), kMostHidden));
  for (const HiddenLoss& one : hidden) {
    if (!is_likely_beside(prior[0], one.gain + prior[1] + std::log(kKeptChance))) break;
    if (!would_be_lost(asked, answer, one)) continue;
    return Fit{false, answer.fit->chance,
               fmt::format("only what is read at {} says that {} is still there; if that is on it no longer, "
                           "the loss of it or of a block beside it is likely",
                           places_in_words(library, one.channels),
                           to_string(library.table.scene(one.row), library.layout))};
  }
  return std::nullopt;
}

}  // namespace

/// The line, if one alone may be off, else the load, if it is not a small one.
std::optional<std::string> cause_that_explains(const QuestionContext& asked) {
  const auto explains = [&](const UnstatedCause& cause) {
    const CauseChances chances = asked.question.chances(cause);
    return chances.without < kSmallestChance && chances.with >= kSmallestChance;
  };
  const auto on_intact = [](const std::string& cause) {
    return cause + " on an intact bridge would explain them";
  };
  for (const LineError& line : asked.question.line_errors(kMostLines))
    if (explains(line.cause)) return on_intact(in_words(line, asked));
  for (const UnstatedLoad& load : asked.question.unstated_loads(1))
    if (load.force >= kLeastForce && explains(load.cause))
      return on_intact(in_words(load, asked.comparison.kind));
  return std::nullopt;
}

std::optional<Fit> find_other(const QuestionContext& asked, const Answer& answer) {
  const bool is_alarm = 1.0 - intact_probability(*answer.posterior) >= kCertain;
  const Alarm alarm = is_alarm ? alarm_of(asked, answer) : Alarm{};
  if (is_alarm)
    if (const auto gross = check_gross_errors(asked, answer, alarm)) return gross;
  if (const auto hidden = check_hidden_losses(asked, answer)) return hidden;
  if (is_alarm)
    if (const auto cause = check_unstated_causes(asked, answer, alarm)) return cause;
  if (const auto sizes = check_sizes(answer.bridge->posterior)) return sizes;
  if (const auto falls = check_falls(asked, answer)) return falls;
  return is_alarm && !asked.observation.unknown_level ? check_stated_errors(asked, answer, alarm)
                                                      : std::nullopt;
}

}  // namespace voussoir
