#include "lookup/checks/other_explanations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lookup/checks/gross_errors.h"
#include "lookup/checks/lines_and_loads.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/unknown/hidden_losses.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostFalls = 10;  // scenes near the readings, of which those that fall are looked at
constexpr std::array kTimesErrors = {3.0, 10.0, 100.0};  // errors that are asked about, of what is stated
constexpr std::size_t kMostHidden = 3;                   // losses that only readings on their blocks exclude
constexpr std::size_t kMostLikely = 10;                  // scenes that each of them competes with
// Beforehand that what was read on a block goes on giving a value when the block is lost: the block is loose
// and carries nothing, but hangs there; a logger repeats its last value; the target was on the one beside it.
constexpr double kKeptChance = 1e-2;

/// Do larger errors than those that are stated explain the readings far better, with no block missing or by
/// scenes that are near them? A scene that scatters much, if errors of 0.02 mm are said to be 0.002, seems
/// to.
std::optional<Fit> check_stated_errors(const QuestionContext& asked, const Alarm& alarm) {
  for (const double times : kTimesErrors) {
    const double log = log_sum_of(asked.question.log_parts_of(alarm.rows, asked.preparation.eligible(),
                                                              asked.preparation.prior(), {.errors = times}));
    if (log > asked.posterior.log_evidence - std::log(kSmallestChance))
      return Fit{false, asked.believed.chance,
                 fmt::format("errors {:g} times as large as stated explain them far better", times)};
  }
  return std::nullopt;
}

/// What falls may come to lie anywhere, so little of its probability is near any readings. Would falls be
/// likely, too, if they showed just what the database has of them, and the best of them is not?
std::optional<Fit> check_falls(const QuestionContext& asked) {
  const UnknownBridge& bridge = asked.question.bridge();
  const SceneTable& table = asked.comparison.library.table;
  std::vector<std::size_t> rows = rows_near(asked, asked.observation, kMostFalls);
  std::erase_if(rows, [&](std::size_t row) { return known_losses(bridge, table, row).all; });
  if (rows.empty()) return std::nullopt;
  const std::vector<double> logs = asked.question.log_parts_of(
      rows, asked.preparation.eligible(), asked.preparation.prior(), {.shown_exactly = true});
  const std::size_t best = rows[static_cast<std::size_t>(std::ranges::max_element(logs) - logs.begin())];
  const auto& likely = asked.posterior.credible;
  if (!is_likely_beside(asked, log_sum_of(logs)) || std::ranges::find(likely, best) != likely.end())
    return std::nullopt;
  return Fit{false, asked.believed.chance,
             fmt::format("what falls without {} would show them, too",
                         to_string(table.scene(best), asked.comparison.library.layout))};
}

/// What a hidden loss competes with, and the scenes with it: alone and beside what the answer calls missing.
std::vector<std::size_t> rows_with_hidden(const QuestionContext& asked, const Observation& others,
                                          BlockId block) {
  const SceneTable& table = asked.comparison.library.table;
  const Eligible& eligible = asked.preparation.eligible();
  const std::vector<std::size_t>& likely = asked.posterior.credible;
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
bool would_be_lost(const QuestionContext& asked, const HiddenLoss& hidden) {
  const SceneTable& table = asked.comparison.library.table;
  const BlockId block = table.scene(hidden.row).removed.front();
  const Observation others = without(asked.observation, hidden.channels);
  const std::vector<std::size_t> rows = rows_with_hidden(asked, others, block);
  const UnknownBridgeQuestion question(asked.comparison, others, asked.settings);
  const std::vector<double> logs =
      question.log_parts_of(rows, asked.preparation.eligible(), asked.preparation.prior(), {});
  double lost = kImpossible, there = kImpossible;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double& sum = table.scene(rows[i]).lacks(block) ? lost : there;
    sum = log_sum(sum, logs[i]);
  }
  return is_likely_beside(there, std::log(kKeptChance) + lost);
}

std::optional<Fit> check_hidden_losses(const QuestionContext& asked) {
  const Library& library = asked.comparison.library;
  const std::vector<double> prior =
      log_prior_by_missing(library.table, asked.preparation.eligible(), asked.preparation.prior());
  std::vector<HiddenLoss> hidden =
      hidden_losses(asked.question.bridge(), asked.observation, asked.comparison.library,
                    asked.preparation.eligible(), asked.gaussians);
  hidden.resize(std::min(hidden.size(), kMostHidden));
  for (const HiddenLoss& one : hidden) {
    if (!is_likely_beside(prior[0],
                          one.gain + prior[1] + library.table.log_weight(one.row) + std::log(kKeptChance)))
      break;
    if (!would_be_lost(asked, one)) continue;
    return Fit{false, asked.believed.chance,
               fmt::format("only what is read at {} says that {} is still there; if that is on it no longer, "
                           "the loss of it or of a block beside it is likely",
                           places_in_words(library, one.channels),
                           to_string(library.table.scene(one.row), library.layout))};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Fit> find_other(const QuestionContext& asked) {
  const bool is_alarm = 1.0 - intact_probability(asked.posterior) >= kCertain;
  const Alarm alarm = is_alarm ? alarm_of(asked) : Alarm{};
  if (is_alarm)
    if (const auto gross = check_gross_errors(asked, alarm)) return gross;
  if (const auto hidden = check_hidden_losses(asked)) return hidden;
  if (is_alarm)
    if (const auto cause = check_lines_and_loads(asked, alarm)) return cause;
  if (const auto sizes = check_sizes(asked.believed)) return sizes;
  if (const auto falls = check_falls(asked)) return falls;
  return is_alarm && !asked.observation.unknown_level ? check_stated_errors(asked, alarm) : std::nullopt;
}

}  // namespace voussoir
