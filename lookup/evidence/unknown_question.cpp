#include "lookup/evidence/unknown_question.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/threads.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/evidence_screen.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/evidence/unknown_screen.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kSmallestCounted = 1e-3;   // [-] levels below it hide in what else is unknown
constexpr double kNegligible = 20.0;        // logarithm of how far behind the likeliest a case is given up
constexpr double kEstimate = 12.0;          // an estimate of a logarithm may be too low by this much
constexpr std::size_t kAtOnce = 16;         // scenes that are worked out before the next look at what matters
constexpr std::size_t kMostWorkedOut = 96;  // scenes; others that may matter count by their estimates

/// Stated, or from 0.1 % by factors of two, equally likely beforehand.
std::vector<double> levels_of(const Observation& observation) {
  if (!observation.unknown_level) return {observation.noise.relative.value_or(0.0)};
  std::vector<double> levels;
  for (double level = kSmallestCounted; level <= kLargestLevel; level *= 2.0) levels.push_back(level);
  return levels;
}

/// All equally likely beforehand.
std::vector<UnknownCase> cases_of(const Observation& observation, Conditions conditions) {
  std::vector<UnknownCase> cases;
  for (const double level : levels_of(observation)) {
    if (conditions == Conditions::known) cases.push_back({level, 0.0});
    if (conditions == Conditions::uncertain)
      for (const double size : kConditionSizes) cases.push_back({level, size});
  }
  return cases;
}

/// Scenes in the order of estimates, and what is known of them.
struct Ranked {
  std::vector<std::size_t> order;  // positions in the eligible rows, best first
  std::vector<double> estimate;    // of each position, with prior and silence
};

Ranked ranked(const std::vector<double>& logs, const std::vector<double>& beforehand) {
  Ranked result{{}, logs};
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (std::isnan(logs[i])) result.estimate[i] = std::numeric_limits<double>::infinity();
    result.estimate[i] += beforehand[i];
    if (result.estimate[i] > kImpossible) result.order.push_back(i);
  }
  std::sort(result.order.begin(), result.order.end(), [&](std::size_t a, std::size_t b) {
    return result.estimate[a] != result.estimate[b] ? result.estimate[a] > result.estimate[b] : a < b;
  });
  return result;
}

/// The largest over some kappa.
std::vector<double> estimates(const UnknownBridge& bridge, const Observation& observation,
                              const SceneTable& table, std::span<const std::size_t> rows) {
  std::vector<double> result(rows.size(), kImpossible);
  for (const double kappa : kEstimatedScatter) {
    const UnknownScreen screen(bridge, observation, table, kappa, hardware_threads());
    const std::vector<double> logs = screen.estimates(rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (std::isnan(logs[i]) || logs[i] > result[i]) result[i] = logs[i];
  }
  return result;
}

/// Whose estimate is right but for what lies in no direction.
void put_intact_first(const SceneTable& table, std::span<const std::size_t> rows, Ranked& scenes) {
  const auto intact = std::find_if(scenes.order.begin(), scenes.order.end(), [&](std::size_t position) {
    return table.removed[rows[position] * table.most_missing] < 0;
  });
  if (intact != scenes.order.end()) std::rotate(scenes.order.begin(), intact, intact + 1);
}

}  // namespace

NoiseModel gaussian_noise(NoiseModel noise) {
  const double deviation = standard_deviation(noise.shape);
  if (noise.relative) *noise.relative *= deviation;
  noise.floor *= deviation;
  noise.shape = NoiseShape::gaussian;
  return noise;
}

UnknownBridgeQuestion::UnknownBridgeQuestion(const Comparison& comparison, const Observation& observation,
                                             const UnknownSettings& settings)
    : comparison_(comparison), observation_(observation), cases_(cases_of(observation, settings.conditions)) {
  require_readings(observation);
  for (const UnknownCase& one : cases_)
    bridges_.push_back(unknown_bridge(comparison, observation, one, settings));
}

/// Works out scenes in the order of their estimates, so many at a time, until what is left cannot matter;
/// then gives the others, if there are too many that may, their estimates shifted by what the worked out ones
/// show.
std::vector<double> UnknownBridgeQuestion::screened(const UnknownBridge& bridge,
                                                    std::span<const std::size_t> rows,
                                                    const std::vector<double>& beforehand, std::size_t count,
                                                    double best_so_far) const {
  const SceneTable& table = comparison_.library.table;
  Ranked scenes = ranked(estimates(bridge, observation_, table, rows), beforehand);
  put_intact_first(table, rows, scenes);
  std::vector<double> result(rows.size(), kImpossible);
  const double negligible = std::log(kScreenedAway / static_cast<double>(rows.size()));
  double best = kImpossible, shift = 0.0;  // of exact less estimate, of the likeliest
  double most_shift = kImpossible;         // and of any
  std::size_t done = 0;
  const auto least = [&] { return best + negligible - most_shift - kEstimate; };
  const auto has_estimate = [&] { return std::isfinite(scenes.estimate[scenes.order[done]]); };
  while (done < scenes.order.size() && (done < std::max(count, kMostWorkedOut) || !has_estimate()) &&
         (done < std::max(count, kAtOnce) || scenes.estimate[scenes.order[done]] >= least())) {
    const std::size_t end = std::min(scenes.order.size(), done + kAtOnce);
    std::vector<std::size_t> next;
    for (std::size_t i = done; i < end; ++i) next.push_back(rows[scenes.order[i]]);
    const std::vector<ScatterLogs> logs = scatter_logs(bridge, observation_, table, next, hardware_threads());
    for (std::size_t i = done; i < end; ++i) {
      const std::size_t at = scenes.order[i];
      result[at] = over_scatter(logs[i - done]);
      if (std::isfinite(scenes.estimate[at]))
        most_shift = std::max(most_shift, result[at] + beforehand[at] - scenes.estimate[at]);
      if (result[at] + beforehand[at] <= best) continue;
      best = result[at] + beforehand[at];
      shift = best - scenes.estimate[at];
    }
    done = end;
    if (best < best_so_far - kNegligible) return result;
  }
  for (; done < scenes.order.size() && scenes.estimate[scenes.order[done]] >= least(); ++done) {
    const std::size_t at = scenes.order[done];
    result[at] = scenes.estimate[at] - beforehand[at] + shift;
  }
  return result;
}

std::vector<double> UnknownBridgeQuestion::log_evidence(const Eligible& eligible, const Prior& prior,
                                                        std::size_t count) {
  const SceneTable& table = comparison_.library.table;
  const std::vector<double> by_missing = log_prior_by_missing(table, eligible, prior);
  const std::vector<double> silence = log_chance_of_silence(observation_, table, eligible.rows);
  std::vector<double> beforehand = silence;
  for (std::size_t i = 0; i < beforehand.size(); ++i) beforehand[i] += by_missing[eligible.missing[i]];
  std::vector<double> result(table.rows, kImpossible);
  double best = kImpossible;
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const std::vector<double> logs = screened(bridges_[i], eligible.rows, beforehand, count, best);
    double likeliest = kImpossible;
    for (std::size_t k = 0; k < logs.size(); ++k) {
      likeliest = std::max(likeliest, logs[k] + beforehand[k]);
      result[eligible.rows[k]] = log_sum(result[eligible.rows[k]], logs[k]);
    }
    if (likeliest > best) best = likeliest, likeliest_ = i;
  }
  const double log_cases = std::log(static_cast<double>(cases_.size()));
  for (std::size_t k = 0; k < eligible.rows.size(); ++k) result[eligible.rows[k]] += silence[k] - log_cases;
  return result;
}

BridgePosterior UnknownBridgeQuestion::posterior(const std::vector<WeightedScene>& scenes) const {
  return bridge_posterior(bridge(), observation_, comparison_.library.table, scenes);
}

}  // namespace voussoir
