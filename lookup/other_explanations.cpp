#include "lookup/other_explanations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/not_a_number.h"
#include "core/units.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/sensor.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostFalls = 10;  // scenes near the readings, of which those that fall are looked at
constexpr std::size_t kMostNear = 3;    // scenes near the readings, asked with larger errors:
constexpr std::array kTimesErrors = {3.0, 10.0, 100.0};  // so many times what is stated
// Beforehand that a reading is off by a size that is given to a factor of e. One in a thousand grossly wrong,
// by anything from its own error to ten thousand times that, comes to about as much.
constexpr double kGrossChance = 2e-4;
constexpr std::size_t kMostSuspects = 2;  // readings, of each scene that is looked at for them

double log_sum_of(const std::vector<double>& logs) {
  return std::accumulate(logs.begin(), logs.end(), kImpossible, log_sum);
}

/// More than a tenth beside what the answer is about.
bool is_likely_beside(const Answer& answer, double log) {
  return log > answer.posterior->log_evidence + std::log((1.0 - kCertain) / kCertain);
}

/// Each once, in ascending order.
std::vector<std::size_t> distinct(std::vector<std::size_t> rows) {
  std::ranges::sort(rows);
  rows.erase(std::ranges::unique(rows).begin(), rows.end());
  return rows;
}

/// Of scenes near the readings.
std::vector<std::size_t> rows_near(const UnknownQuestion& asked, const Observation& observation,
                                   std::size_t count) {
  std::vector<std::size_t> rows;
  for (const ScoredRow& near : asked.preparation.smallest_misfits(observation, count))
    rows.push_back(near.row);
  return rows;
}

/// The intact bridge and what is near the readings, that any of these may be the truth.
std::vector<std::size_t> rows_beside(const UnknownQuestion& asked, const Answer& answer) {
  std::vector<std::size_t> rows = rows_near(asked, asked.observation, kMostNear);
  rows.push_back(answer.posterior->credible.front());
  const Eligible& eligible = asked.preparation.eligible();
  if (eligible.missing.front() == 0) rows.push_back(eligible.rows.front());
  return distinct(std::move(rows));
}

/// Do larger errors than those that are stated explain the readings far better, with no block missing or by
/// scenes that are near them? A scene that scatters much, if errors of 0.02 mm are said to be 0.002, seems
/// to.
std::optional<Fit> check_stated_errors(const UnknownQuestion& asked, const Answer& answer,
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
std::optional<Fit> check_falls(const UnknownQuestion& asked, const Answer& answer) {
  const UnknownBridge& bridge = asked.question.bridge();
  const SceneTable& table = asked.library.table;
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
                         to_string(table.scene(best), asked.library.layout))};
}

/// The readings that are farthest from what all others let expect of a scene, in standard deviations, and how
/// far they are.
std::vector<GrossError> suspects_of(const UnknownQuestion& asked, std::size_t row) {
  const BridgePosterior believed = asked.question.posterior({{row, 1.0}});
  const std::vector<ReadingRow>& readings = asked.question.bridge().rows;
  std::vector<std::size_t> order(readings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto at = [](const Eigen::VectorXd& values, std::size_t k) {
    return std::abs(values[static_cast<Eigen::Index>(k)]);
  };
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t k) { return at(believed.others, k); });
  std::vector<GrossError> suspects;
  for (const std::size_t k : order) {  // a channel that counts in two epochs has two of them
    if (suspects.size() == kMostSuspects) break;
    if (std::ranges::find(suspects, readings[k].channel, &GrossError::channel) == suspects.end())
      suspects.push_back({readings[k].channel, at(believed.beside, k)});
  }
  return suspects;
}

/// What is near the readings but one.
std::vector<std::size_t> rows_without(const UnknownQuestion& asked, std::size_t channel) {
  Observation others = asked.observation;
  others.displacement[channel] = others.reading[channel] = kNan;
  return rows_near(asked, others, kMostNear);
}

/// Of these rows those that readings leave possible and that lack not all of the named blocks; of none named
/// those that lack none.
std::vector<std::size_t> rows_otherwise(const UnknownQuestion& asked, std::vector<std::size_t> rows,
                                        const std::vector<BlockId>& named) {
  const SceneTable& table = asked.library.table;
  rows = distinct(std::move(rows));
  std::erase_if(rows, [&](std::size_t row) {
    const Scene scene = table.scene(row);
    const bool has_all = std::ranges::all_of(named, [&](BlockId block) { return scene.lacks(block); });
    return (has_all && !scene.removed.empty()) ||
           !scene_loss(asked.question.bridge(), asked.observation, table, row);
  });
  return rows;
}

/// A scene that would explain all but one reading if that is grossly wrong; null unless it would be likely.
std::optional<Scene> explained_by(const UnknownQuestion& asked, const Answer& answer, const GrossError& gross,
                                  std::vector<std::size_t> rows, const std::vector<BlockId>& named) {
  const std::vector<std::size_t> near = rows_without(asked, gross.channel);
  rows.insert(rows.end(), near.begin(), near.end());
  const std::vector<std::size_t> others = rows_otherwise(asked, std::move(rows), named);
  if (others.empty()) return std::nullopt;
  const std::vector<double> logs =
      asked.question.log_parts_of(others, asked.preparation.eligible(), answer.prior, {.gross = gross});
  if (!is_likely_beside(answer, std::log(kGrossChance) + log_sum_of(logs))) return std::nullopt;
  return asked.library.table.scene(
      others[static_cast<std::size_t>(std::ranges::max_element(logs) - logs.begin())]);
}

/// Is it one reading alone that says what the answer calls missing? If it were grossly wrong, would others
/// explain the rest?
std::optional<Fit> check_single_readings(const UnknownQuestion& asked, const Answer& answer,
                                         const std::vector<std::size_t>& rows) {
  const std::vector<BlockId> named = likely_blocks(*answer.posterior, kCertain);
  for (const std::size_t row : rows_otherwise(asked, rows, named))
    for (const GrossError& gross : suspects_of(asked, row)) {
      const auto scene = explained_by(asked, answer, gross, rows, named);
      if (!scene) continue;
      const StoredPoint& point = asked.library.points[gross.channel];
      return Fit{
          false, answer.fit->chance,
          fmt::format("only the reading at {} says that {} missing; were it wrong by {:.2g} {}, {} would be "
                      "likely, too",
                      point.name, named.empty() ? "blocks are" : "these blocks are",
                      kMillimetres * gross.size, unit_of(point.quantity),
                      scene->removed.empty() ? "an intact bridge" : to_string(*scene, asked.library.layout))};
    }
  return std::nullopt;
}

}  // namespace

std::optional<Fit> find_other(const UnknownQuestion& asked, const Answer& answer) {
  const bool is_alarm = 1.0 - intact_probability(*answer.posterior) >= kCertain;
  const std::vector<std::size_t> rows = is_alarm ? rows_beside(asked, answer) : std::vector<std::size_t>();
  if (is_alarm)
    if (const auto single = check_single_readings(asked, answer, rows)) return single;
  if (const auto sizes = check_sizes(answer.bridge->posterior)) return sizes;
  if (const auto falls = check_falls(asked, answer)) return falls;
  return is_alarm && !asked.observation.unknown_level ? check_stated_errors(asked, answer, rows)
                                                      : std::nullopt;
}

}  // namespace voussoir
