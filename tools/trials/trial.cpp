#include "tools/trials/trial.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/error.h"
#include "lookup/readings/stated_sigmas.h"

namespace voussoir {
namespace {

double brier_score(const Posterior& posterior, std::size_t truth) {
  double sum = 1.0 - 2.0 * posterior.probability[truth];
  for (const double probability : posterior.probability.values) sum += probability * probability;
  return sum;
}

/// How many trials there are of a bridge, and how many of them count.
struct OfBridge {
  double trials = 0.0;
  double counting = 0.0;
};

Share share_of(const std::vector<Trial>& trials, const std::function<double(const Trial&)>& counts) {
  std::map<std::size_t, OfBridge> bridges;
  double counting = 0.0;
  for (const Trial& trial : trials) {
    OfBridge& bridge = bridges[trial.bridge];
    ++bridge.trials;
    const double count = counts(trial);
    bridge.counting += count;
    counting += count;
  }
  const auto n = static_cast<double>(trials.size()), b = static_cast<double>(bridges.size());
  const double value = counting / n;
  double squares = 0.0;
  for (const auto& [number, bridge] : bridges)
    squares += std::pow(bridge.counting - bridge.trials * value, 2);
  return {value, b > 1.0 ? std::sqrt(squares * b / (b - 1.0)) / n : std::sqrt(value * (1.0 - value) / n)};
}

/// Adds one trial's sums to those of all.
void add(const std::vector<ReliabilityBin>& bins, std::vector<ReliabilityBin>& sum) {
  for (std::size_t i = 0; i < bins.size(); ++i) {
    sum[i].scenes += bins[i].scenes;
    sum[i].mean_probability += bins[i].mean_probability;
    sum[i].frequency += bins[i].frequency;
    sum[i].standard_error += bins[i].standard_error;
  }
}

bool names_sound_block(const Posterior& posterior, const Scene& truth) {
  return std::ranges::any_of(likely_blocks(posterior, kCertain), [&](BlockId block) {
    return std::ranges::find(truth.removed, block) == truth.removed.end();
  });
}

}  // namespace

bool is_alarm(Verdict verdict) {
  return verdict == Verdict::located || verdict == Verdict::damaged_unlocated;
}

std::array<Verdict, kVerdicts> all_verdicts() {
  return {Verdict::located, Verdict::damaged_unlocated, Verdict::intact, Verdict::cannot_tell,
          Verdict::unexplained};
}

Trial ask(const Asking& asking, const ReadingsFile& readings, std::size_t truth) {
  const Comparison comparison = compare(readings, asking.sensors, asking.database,
                                        {.known_bridge = asking.known_bridge, .sampled = asking.sampled});
  LookupSettings settings = asking.lookup;
  settings.known_bridge = asking.known_bridge;
  settings.epochs =
      readings.two_epochs && !counts_as_known(comparison, settings) ? Epochs::both : Epochs::change;
  settings.noise = noise_of(comparison.measured, settings.noise);
  const Answer answer = locate_damage(comparison, settings);
  const Posterior& posterior = answer.posterior.value();
  const auto& set = posterior.credible;
  Trial trial;
  trial.first = place_of(truth, posterior) == 0;
  trial.in_credible = std::ranges::find(set, truth) != set.end();
  trial.in_exact = held_by_exact_set(truth, posterior);
  trial.set_size = set.size();
  for (const std::size_t row : set) trial.in_set += posterior.probability[row];
  trial.likeliest = set.empty() ? 0.0 : posterior.probability[set.front()];
  trial.brier = brier_score(posterior, truth);
  trial.verdict = verdict_of(answer);
  trial.names_sound =
      trial.verdict == Verdict::located && names_sound_block(posterior, asking.database.table().scene(truth));
  trial.bins = unfinished_bins();
  add_to_bins(posterior, truth, trial.bins);
  return trial;
}

TrialRates rates_of(const std::vector<Trial>& trials) {
  TrialRates rates{.trials = trials.size(),
                   .first = share_of(trials, [](const Trial& trial) { return trial.first; }),
                   .in_credible = share_of(trials, [](const Trial& trial) { return trial.in_credible; }),
                   .in_exact = share_of(trials, [](const Trial& trial) { return trial.in_exact; }),
                   .wrong_and_sure = share_of(
                       trials, [](const Trial& trial) { return !trial.first && trial.likeliest > kCertain; }),
                   .alarm = share_of(trials, [](const Trial& trial) { return is_alarm(trial.verdict); }),
                   .names_sound = share_of(trials, [](const Trial& trial) { return trial.names_sound; }),
                   .bins = unfinished_bins()};
  std::map<std::size_t, int> bridges;
  for (const Trial& trial : trials) {
    ++bridges[trial.bridge];
    rates.mean_set_size += static_cast<double>(trial.set_size) / static_cast<double>(trials.size());
    rates.mean_in_set += trial.in_set / static_cast<double>(trials.size());
    rates.mean_brier += trial.brier / static_cast<double>(trials.size());
    ++rates.verdicts[static_cast<std::size_t>(trial.verdict)];
    add(trial.bins, rates.bins);
  }
  rates.bridges = bridges.size();
  finish_bins(rates.bins);
  return rates;
}

}  // namespace voussoir
