/// @file Trials counted: shares, sets and reliability.

#include <catch2/catch.hpp>

#include <cmath>

#include "tools/trials/study_report.h"
#include "tools/trials/trial.h"

using namespace voussoir;

namespace {

Trial trial(std::size_t bridge, bool first, double likeliest) {
  Trial result;
  result.bridge = bridge;
  result.first = first;
  result.likeliest = likeliest;
  result.verdict = first ? Verdict::located : Verdict::cannot_tell;
  result.names_sound = !first;
  result.bins = unfinished_bins();
  return result;
}

}  // namespace

TEST_CASE("Shares of trials come with the standard error between bridges (worked out by hand)") {
  // Bridge 0: 3 of 4 count, bridge 1: 1 of 4, bridge 2: 2 of 2. Share 0.6; sum of squares of k - 0.6 n:
  // 0.6^2 + 1.4^2 + 0.8^2 = 2.96, times 3 / 2, root, over 10.
  std::vector<Trial> trials;
  for (const auto& [bridge, first] : std::vector<std::pair<std::size_t, bool>>{{0, true},
                                                                               {0, true},
                                                                               {0, true},
                                                                               {0, false},
                                                                               {1, true},
                                                                               {1, false},
                                                                               {1, false},
                                                                               {1, false},
                                                                               {2, true},
                                                                               {2, true}})
    trials.push_back(trial(bridge, first, 0.95));
  const TrialRates rates = rates_of(trials);
  CHECK(rates.trials == 10);
  CHECK(rates.bridges == 3);
  CHECK(rates.first.value == Approx(0.6));
  CHECK(rates.first.standard_error == Approx(std::sqrt(2.96 * 1.5) / 10.0));
  CHECK(rates.wrong_and_sure.value == Approx(0.4));
  CHECK(rates.alarm.value == Approx(0.6));
  CHECK(rates.names_sound.value == Approx(0.4));
  CHECK(rates.verdicts[static_cast<std::size_t>(Verdict::located)] == 6);
  CHECK(rates.verdicts[static_cast<std::size_t>(Verdict::cannot_tell)] == 4);
}

TEST_CASE("One trial a bridge has the standard error of independent trials (binomial)") {
  std::vector<Trial> trials;
  for (std::size_t bridge = 0; bridge < 200; ++bridge) trials.push_back(trial(bridge, bridge % 4 == 0, 0.5));
  const Share first = rates_of(trials).first;
  CHECK(first.value == Approx(0.25));
  CHECK(first.standard_error == Approx(std::sqrt(0.25 * 0.75 / 199.0)));
}

TEST_CASE("A set of exactly 95 % holds truths drawn by their probabilities in exactly 95 % (closed form)") {
  Posterior posterior;
  posterior.probability = {0.0, {1, 3, 5, 7}, {0.3, 0.6, 0.02, 0.08}};
  posterior.credible = {3, 1, 7};
  CHECK(held_by_exact_set(3, posterior) == 1.0);
  CHECK(held_by_exact_set(1, posterior) == 1.0);
  CHECK(held_by_exact_set(7, posterior) == Approx(0.05 / 0.08));
  CHECK(held_by_exact_set(5, posterior) == 0.0);
  double held = 0.0;
  for (const std::size_t row : posterior.probability.rows)
    held += posterior.probability[row] * held_by_exact_set(row, posterior);
  CHECK(held == Approx(kCredibleShare));
  posterior.probability.values = {0.01, 0.99, 0.0, 0.0};
  posterior.credible = {3};
  CHECK(held_by_exact_set(3, posterior) == Approx(kCredibleShare / 0.99));
}

TEST_CASE("Bins of several series joined are those of all answers at once") {
  Posterior answer;
  answer.probability = {0.0, {0, 1, 2}, {0.05, 0.15, 0.8}};
  std::vector<ReliabilityBin> first = unfinished_bins(), second = unfinished_bins(), both = unfinished_bins();
  for (auto* bins : {&first, &both}) add_to_bins(answer, 2, *bins);
  answer.probability = {0.0, {0, 1, 2}, {0.0005, 0.1995, 0.8}};
  for (auto* bins : {&second, &both}) add_to_bins(answer, 1, *bins);
  for (auto* bins : {&first, &second, &both}) finish_bins(*bins);
  std::vector<StudyRow> rows(3);
  rows[0].rates.bins = first;
  rows[1].rates.bins = second;
  rows[2].rates.bins = second;
  rows[2].known_bridge = true;
  const std::vector<ReliabilityBin> joined = joined_bins(rows, false);
  CHECK(joined[8].scenes == 2);
  CHECK(joined[8].frequency == Approx(0.5));
  CHECK(joined[0].scenes == 1);
  for (std::size_t i = 0; i < both.size(); ++i) {
    CHECK(joined[i].scenes == both[i].scenes);
    CHECK(joined[i].mean_probability == Approx(both[i].mean_probability));
    CHECK(joined[i].frequency == Approx(both[i].frequency));
    CHECK(joined[i].standard_error == Approx(both[i].standard_error));
  }
}
