#include "lookup/evidence/unknown_question.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "lookup/evidence/evidence.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kSmallestCounted = 1e-3;  // [-] levels below it hide in what else is unknown
constexpr double kNegligible = 20.0;       // logarithm of what an unlikely level is behind the likeliest

/// Stated, or from 0.1 % by factors of two, equally likely beforehand.
std::vector<double> levels_of(const Observation& observation) {
  if (!observation.unknown_level) return {observation.noise.relative.value_or(0.0)};
  std::vector<double> levels;
  for (double level = kSmallestCounted; level <= kLargestLevel; level *= 2.0) levels.push_back(level);
  return levels;
}

double largest(const std::vector<double>& logs) {
  return logs.empty() ? kImpossible : *std::max_element(logs.begin(), logs.end());
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
                                             double scale, Epochs epochs)
    : comparison_(comparison), observation_(observation), levels_(levels_of(observation)) {
  require_readings(observation);
  for (const double level : levels_)
    bridges_.push_back(unknown_bridge(comparison, observation, level, scale, epochs));
}

std::vector<double> UnknownBridgeQuestion::log_evidence(const Eligible& eligible, const Prior& prior,
                                                        std::size_t count) {
  const SceneTable& table = comparison_.library.table;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<double> result(table.rows, kImpossible);
  double best = kImpossible;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    std::vector<double> logs;
    for (const ScatterLogs& each : scatter_logs(bridges_[i], observation_, table, eligible.rows, threads))
      logs.push_back(over_scatter(each));
    if (const double own = largest(logs); own > best) best = own, likeliest_ = i;
    for (std::size_t k = 0; k < logs.size(); ++k)
      result[eligible.rows[k]] = log_sum(result[eligible.rows[k]], logs[k]);
  }
  const std::vector<double> silence = log_chance_of_silence(observation_, table, eligible.rows);
  const double log_levels = std::log(static_cast<double>(levels_.size()));
  for (std::size_t k = 0; k < eligible.rows.size(); ++k) result[eligible.rows[k]] += silence[k] - log_levels;
  return result;
}

BridgePosterior UnknownBridgeQuestion::posterior(const std::vector<WeightedScene>& scenes) const {
  return bridge_posterior(bridge(), observation_, comparison_.library.table, scenes);
}

}  // namespace voussoir
