#include "lookup/unknown/unknown_question.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "core/threads.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/search/eligible_rows.h"
#include "lookup/unknown/screened_cases.h"

namespace voussoir {
namespace {

constexpr double kSmallestCounted = 1e-3;  // [-] levels below it hide in what else is unknown

/// Stated, or from 0.1 % by factors of two, equally likely beforehand.
std::vector<double> levels_of(const Observation& observation) {
  if (!observation.unknown_level) return {observation.noise.relative.value_or(0.0)};
  std::vector<double> levels;
  for (double level = kSmallestCounted; level <= kLargestLevel; level *= 2.0) levels.push_back(level);
  std::reverse(levels.begin(), levels.end());
  return levels;
}

/// All equally likely beforehand; those with the widest covariances first.
std::vector<UnknownCase> cases_of(const Observation& observation, Conditions conditions) {
  std::vector<UnknownCase> cases;
  for (const double level : levels_of(observation)) {
    if (conditions == Conditions::known) cases.push_back({level, 0.0});
    if (conditions == Conditions::uncertain)
      for (const double size : std::views::reverse(kConditionSizes)) cases.push_back({level, size});
  }
  return cases;
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
  bridge_ = unknown_bridge(comparison, observation, settings);
}

/// Rows that are impossible beforehand, as no such number of blocks can be missing or a sensor would not be
/// silent, are not asked about.
UnknownEvidence UnknownBridgeQuestion::evidence(const Eligible& eligible, const Prior& prior,
                                                std::size_t count) const {
  const SceneTable& table = comparison_.library.table;
  const std::vector<double> by_missing = log_prior_by_missing(table, eligible, prior);
  const std::vector<double> silence = log_chance_of_silence(observation_, table, eligible.rows);
  std::vector<std::size_t> rows;
  std::vector<double> beforehand, of_silence;
  rows.reserve(silence.size());
  beforehand.reserve(silence.size());
  of_silence.reserve(silence.size());
  for (std::size_t i = 0; i < silence.size(); ++i) {
    const double log = by_missing[eligible.missing[i]] + table.log_weight(eligible.rows[i]) + silence[i];
    if (log == kImpossible) continue;
    rows.push_back(eligible.rows[i]);
    beforehand.push_back(log);
    of_silence.push_back(silence[i]);
  }
  ScreenedCases screened(bridge_, observation_, table, cases_, rows, beforehand);
  RowValues result{kImpossible, {}, {}};
  for (const auto& [place, log] : screened.evidence(count)) {
    result.rows.push_back(rows[place]);
    result.values.push_back(log + of_silence[place]);
  }
  return {std::move(result), cases_[screened.likeliest()]};
}

std::vector<double> UnknownBridgeQuestion::log_parts_of(std::span<const std::size_t> rows,
                                                        const Eligible& eligible, const Prior& prior,
                                                        const Supposition& supposed) const {
  const SceneTable& table = comparison_.library.table;
  Observation wider = observation_;
  for (double& share : wider.share) share *= supposed.errors;
  for (double& floor : wider.floor) floor *= supposed.errors;
  for (const GrossError& gross : supposed.gross) wider.floor[gross.channel] += gross.size;
  std::vector<CaseTerms> terms;
  for (const UnknownCase& one : cases_) {
    CaseNoise noise = case_noise(bridge_, wider, one);
    if (supposed.beside.size() > 0) noise.covariance += supposed.beside;
    if (supposed.shown_exactly) noise.spread = 0.0;
    terms.push_back(case_terms(noise));
  }
  const auto logs = SceneLikelihoods(bridge_, wider, table)(terms, rows, {}, hardware_threads());
  const std::vector<double> beforehand = log_prior_by_missing(table, eligible, prior);
  const std::vector<double> silence = log_chance_of_silence(observation_, table, {rows.begin(), rows.end()});
  const double log_cases = std::log(static_cast<double>(terms.size()));
  std::vector<double> parts(rows.size(), kImpossible);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::size_t at = i / terms.size();
    const auto missing = static_cast<std::size_t>(missing_blocks(table, rows[at]));
    const double before = beforehand[missing] + table.log_weight(rows[at]);
    parts[at] = log_sum(parts[at], over_scatter(logs[i]) + before + silence[at] - log_cases);
  }
  return parts;
}

std::vector<IntactGaussian> UnknownBridgeQuestion::gaussians_at(double level) const {
  std::vector<UnknownCase> cases = cases_;
  std::erase_if(cases, [&](const UnknownCase& one) { return one.level != level; });
  return intact_gaussians(bridge_, observation_, cases);
}

BridgePosterior UnknownBridgeQuestion::posterior(const std::vector<WeightedScene>& scenes) const {
  return bridge_posterior(bridge_, observation_, comparison_.library.table, scenes, cases_);
}

}  // namespace voussoir
