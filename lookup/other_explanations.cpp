#include "lookup/other_explanations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/not_a_number.h"
#include "core/text.h"
#include "core/units.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/sensor.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostFalls = 10;  // scenes near the readings, of which those that fall are looked at
constexpr std::size_t kMostNear = 3;    // scenes near the readings, asked with larger errors:
constexpr std::array kTimesErrors = {3.0, 10.0, 100.0};  // so many times what is stated
// Beforehand that a reading is off by a size that is given to a factor of e. One in a thousand grossly wrong,
// by anything from its own error to ten thousand times that, comes to about as much.
constexpr double kGrossChance = 2e-4;
constexpr double kOfOneBlock = 0.1;      // share of these that are of all that is read on a block
constexpr std::size_t kMostHidden = 3;   // losses that only readings on their blocks exclude
constexpr std::size_t kMostLikely = 10;  // scenes that each of them competes with
// Beforehand that what was read on a block goes on giving a value when the block is lost: the block is loose
// and carries nothing, but hangs there; a logger repeats its last value; the target was on the one beside it.
constexpr double kKeptChance = 1e-2;
constexpr std::size_t kMostSuspects = 2;  // readings, of each scene that is looked at for them

double log_sum_of(const std::vector<double>& logs) {
  return std::accumulate(logs.begin(), logs.end(), kImpossible, log_sum);
}

/// More than a tenth beside something else.
bool is_likely_beside(double log_other, double log) {
  return log > log_other + std::log((1.0 - kCertain) / kCertain);
}
/// The same beside what the answer is about.
bool is_likely_beside(const Answer& answer, double log) {
  return is_likely_beside(answer.posterior->log_evidence, log);
}

/// "T1, T2"
std::string places_in_words(const Library& library, const std::vector<std::size_t>& channels) {
  std::vector<std::string> names;
  for (const std::size_t channel : channels) names.push_back(library.points[channel].name);
  return names_in_words(names);
}

std::vector<std::size_t> channels_of(const std::vector<GrossError>& gross) {
  std::vector<std::size_t> channels;
  for (const GrossError& one : gross) channels.push_back(one.channel);
  return channels;
}

/// Each once, in ascending order.
std::vector<std::size_t> distinct(std::vector<std::size_t> rows) {
  std::ranges::sort(rows);
  rows.erase(std::ranges::unique(rows).begin(), rows.end());
  return rows;
}

/// Of scenes near the readings.
std::vector<std::size_t> rows_near(const QuestionContext& asked, const Observation& observation,
                                   std::size_t count) {
  std::vector<std::size_t> rows;
  for (const ScoredRow& near : asked.preparation.smallest_misfits(observation, count))
    rows.push_back(near.row);
  return rows;
}

/// The intact bridge and what is near the readings, that any of these may be the truth.
std::vector<std::size_t> rows_beside(const QuestionContext& asked, const Answer& answer) {
  std::vector<std::size_t> rows = rows_near(asked, asked.observation, kMostNear);
  rows.push_back(answer.posterior->credible.front());
  const Eligible& eligible = asked.preparation.eligible();
  if (eligible.missing.front() == 0) rows.push_back(eligible.rows.front());
  return distinct(std::move(rows));
}

/// Do larger errors than those that are stated explain the readings far better, with no block missing or by
/// scenes that are near them? A scene that scatters much, if errors of 0.02 mm are said to be 0.002, seems
/// to.
std::optional<Fit> check_stated_errors(const QuestionContext& asked, const Answer& answer,
                                       const std::vector<std::size_t>& rows) {
  for (const double times : kTimesErrors) {
    const double log = log_sum_of(
        asked.question.log_parts_of(rows, asked.preparation.eligible(), answer.prior, {.errors = times}));
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

/// The same readings without those of some channels.
Observation without(Observation observation, std::span<const std::size_t> channels) {
  for (const std::size_t channel : channels)
    observation.displacement[channel] = observation.reading[channel] = kNan;
  return observation;
}

/// By how much these readings are off what all others let expect of a scene.
std::vector<GrossError> errors_of(const UnknownBridge& bridge, const BridgePosterior& believed,
                                  const std::vector<std::size_t>& channels) {
  std::vector<Index> rows;
  for (std::size_t k = 0; k < bridge.rows.size(); ++k)
    if (std::ranges::find(channels, bridge.rows[k].channel) != channels.end())
      rows.push_back(static_cast<Index>(k));
  const auto& covariance = believed.parts.front().covariance;
  const MatrixXd identity = MatrixXd::Identity(covariance.rows(), covariance.rows());
  const MatrixXd inverse = covariance.solve(MatrixXd(identity(Eigen::all, rows)));
  const VectorXd pulled = covariance.solve(bridge.reading - believed.signal);
  const VectorXd beside = inverse(rows, Eigen::all).llt().solve(pulled(rows));
  std::vector<GrossError> errors;
  for (const std::size_t channel : channels) errors.push_back({channel, 0.0});
  for (std::size_t i = 0; i < rows.size(); ++i) {  // a channel that counts in two epochs has two rows
    const std::size_t channel = bridge.rows[static_cast<std::size_t>(rows[i])].channel;
    double& size = std::ranges::find(errors, channel, &GrossError::channel)->size;
    size = std::max(size, std::abs(beside[static_cast<Index>(i)]));
  }
  return errors;
}

/// The readings that are farthest from what all others let expect of a scene, in standard deviations: each
/// alone, and with all that is read on the same block.
std::vector<std::vector<GrossError>> suspects_of(const QuestionContext& asked, std::size_t row) {
  const BridgePosterior believed = asked.question.posterior({{row, 1.0}});
  const UnknownBridge& bridge = asked.question.bridge();
  const std::vector<StoredPoint>& points = asked.comparison.library.points;
  std::vector<std::size_t> order(bridge.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t k) { return std::abs(believed.others[static_cast<Index>(k)]); });
  std::vector<std::size_t> channels;  // a channel that counts in two epochs has two rows
  for (const std::size_t k : order)
    if (std::ranges::find(channels, bridge.rows[k].channel) == channels.end())
      channels.push_back(bridge.rows[k].channel);
  std::vector<std::vector<GrossError>> suspects;
  for (const std::size_t channel : std::span(channels).first(std::min(channels.size(), kMostSuspects))) {
    suspects.push_back(errors_of(bridge, believed, {channel}));
    std::vector<std::size_t> beside;
    std::ranges::copy_if(channels, std::back_inserter(beside),
                         [&](std::size_t other) { return points[other].is_on(points[channel].block); });
    if (beside.size() > 1) suspects.push_back(errors_of(bridge, believed, beside));
  }
  return suspects;
}

/// Of these rows those that readings leave possible and that lack not all of the named blocks; of none named
/// those that lack none.
std::vector<std::size_t> rows_otherwise(const QuestionContext& asked, std::vector<std::size_t> rows,
                                        const std::vector<BlockId>& named) {
  const SceneTable& table = asked.comparison.library.table;
  rows = distinct(std::move(rows));
  std::erase_if(rows, [&](std::size_t row) {
    const Scene scene = table.scene(row);
    const bool has_all = std::ranges::all_of(named, [&](BlockId block) { return scene.lacks(block); });
    return (has_all && !scene.removed.empty()) ||
           !scene_loss(asked.question.bridge(), asked.observation, table, row);
  });
  return rows;
}

/// A scene that would explain all other readings if these are grossly wrong; null unless it would be likely.
std::optional<Scene> explained_by(const QuestionContext& asked, const Answer& answer,
                                  const std::vector<GrossError>& gross, std::vector<std::size_t> rows,
                                  const std::vector<BlockId>& named) {
  const std::vector<std::size_t> near =
      rows_near(asked, without(asked.observation, channels_of(gross)), kMostNear);
  rows.insert(rows.end(), near.begin(), near.end());
  const std::vector<std::size_t> others = rows_otherwise(asked, std::move(rows), named);
  if (others.empty()) return std::nullopt;
  const std::vector<double> logs =
      asked.question.log_parts_of(others, asked.preparation.eligible(), answer.prior, {.gross = gross});
  const double chance = gross.size() > 1 ? kOfOneBlock * kGrossChance : kGrossChance;
  if (!is_likely_beside(answer, std::log(chance) + log_sum_of(logs))) return std::nullopt;
  return asked.comparison.library.table.scene(
      others[static_cast<std::size_t>(std::ranges::max_element(logs) - logs.begin())]);
}

/// "only the reading at T2 says that these blocks are missing; were it wrong by 0.1 mm".
std::string in_words(const std::vector<GrossError>& gross, bool named, const Library& library) {
  const GrossError& largest = *std::ranges::max_element(gross, {}, &GrossError::size);
  const bool alone = gross.size() == 1;
  return fmt::format("only the reading{} at {} say{} that {} missing; were {} wrong by {:.2g} {}",
                     alone ? "" : "s", places_in_words(library, channels_of(gross)), alone ? "s" : "",
                     named ? "these blocks are" : "blocks are", alone ? "it" : "they",
                     kMillimetres * largest.size, unit_of(library.points[largest.channel].quantity));
}

/// Is it one reading alone, or what is read on one block, that says what the answer calls missing? If that
/// were grossly wrong, would others explain the rest?
std::optional<Fit> check_single_readings(const QuestionContext& asked, const Answer& answer,
                                         const std::vector<std::size_t>& rows) {
  const Library& library = asked.comparison.library;
  const std::vector<BlockId> named = likely_blocks(*answer.posterior, kCertain);
  for (const std::size_t row : rows_otherwise(asked, rows, named))
    for (const std::vector<GrossError>& gross : suspects_of(asked, row))
      if (const auto scene = explained_by(asked, answer, gross, rows, named))
        return Fit{
            false, answer.fit->chance,
            fmt::format("{}, {} would be likely, too", in_words(gross, !named.empty(), library),
                        scene->removed.empty() ? "an intact bridge" : to_string(*scene, library.layout))};
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

std::optional<Fit> find_other(const QuestionContext& asked, const Answer& answer) {
  const bool is_alarm = 1.0 - intact_probability(*answer.posterior) >= kCertain;
  const std::vector<std::size_t> rows = is_alarm ? rows_beside(asked, answer) : std::vector<std::size_t>();
  if (is_alarm)
    if (const auto single = check_single_readings(asked, answer, rows)) return single;
  if (const auto sizes = check_sizes(answer.bridge->posterior)) return sizes;
  if (const auto falls = check_falls(asked, answer)) return falls;
  if (const auto hidden = check_hidden_losses(asked, answer)) return hidden;
  return is_alarm && !asked.observation.unknown_level ? check_stated_errors(asked, answer, rows)
                                                      : std::nullopt;
}

}  // namespace voussoir
