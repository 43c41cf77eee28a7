#include "lookup/other_explanations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostFalls = 10;  // scenes near the readings, of which those that fall are looked at
constexpr std::size_t kMostNear = 3;    // scenes near the readings, asked with larger errors:
constexpr std::array kTimesErrors = {3.0, 10.0, 100.0};  // so many times what is stated

double log_sum_of(const std::vector<double>& logs) {
  return std::accumulate(logs.begin(), logs.end(), kImpossible, log_sum);
}

/// Do larger errors than those that are stated explain the readings far better, with no block missing or by
/// scenes that are near them? A scene that scatters much, if errors of 0.02 mm are said to be 0.002, seems
/// to.
std::optional<Fit> check_stated_errors(const UnknownQuestion& asked, const Answer& answer) {
  std::vector<std::size_t> rows = {answer.posterior->credible.front()};
  for (const ScoredRow& near : asked.preparation.smallest_misfits(asked.observation, kMostNear))
    rows.push_back(near.row);
  const Eligible& eligible = asked.preparation.eligible();
  if (eligible.missing.front() == 0) rows.push_back(eligible.rows.front());
  std::ranges::sort(rows);
  rows.erase(std::ranges::unique(rows).begin(), rows.end());
  for (const double times : kTimesErrors) {
    const double log =
        log_sum_of(asked.question.log_parts_of(rows, eligible, answer.prior, {.errors = times}));
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
  const auto falls = [&](std::size_t row) { return !known_losses(bridge, table, row).all; };
  std::vector<std::size_t> rows;
  for (const ScoredRow& near : asked.preparation.smallest_misfits(asked.observation, kMostFalls))
    if (falls(near.row)) rows.push_back(near.row);
  if (rows.empty()) return std::nullopt;
  const std::vector<double> logs =
      asked.question.log_parts_of(rows, asked.preparation.eligible(), answer.prior, {.shown_exactly = true});
  const std::size_t best = rows[static_cast<std::size_t>(std::ranges::max_element(logs) - logs.begin())];
  const bool are_likely =
      log_sum_of(logs) > answer.posterior->log_evidence + std::log((1.0 - kCertain) / kCertain);
  const auto& likely = answer.posterior->credible;
  if (!are_likely || std::ranges::find(likely, best) != likely.end()) return std::nullopt;
  return Fit{false, answer.fit->chance,
             fmt::format("what falls without {} would show them, too",
                         to_string(table.scene(best), asked.library.layout))};
}

}  // namespace

std::optional<Fit> find_other(const UnknownQuestion& asked, const Answer& answer) {
  if (const auto falls = check_falls(asked, answer)) return falls;
  const bool is_alarm = 1.0 - intact_probability(*answer.posterior) >= kCertain;
  return is_alarm && !asked.observation.unknown_level ? check_stated_errors(asked, answer) : std::nullopt;
}

}  // namespace voussoir
