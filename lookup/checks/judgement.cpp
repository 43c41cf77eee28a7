#include "lookup/checks/judgement.h"

#include <algorithm>
#include <span>

#include "lookup/checks/fewer_readings.h"
#include "lookup/checks/lines_and_loads.h"
#include "lookup/checks/other_explanations.h"
#include "lookup/checks/plausible_readings.h"
#include "lookup/checks/turned_readings.h"
#include "lookup/unknown/case_noise.h"

namespace voussoir {
namespace {

// Chosen, not tuned.
constexpr std::size_t kMostChecked = 20;  // scenes whose fit is checked
constexpr std::size_t kMostMixed = 3;     // scenes that say together what the bridge is like

/// The predictive check: how likely a fit as bad as this is, on average over the likeliest scenes.
Fit average_fit(const AskedReadings& asked, const NoiseEstimate& noise) {
  const Posterior& posterior = asked.posterior;
  if (posterior.credible.empty()) return {false, 0.0, "every scene is excluded by at least one reading"};
  std::optional<Fit> likeliest;
  double chance = 0.0, weight = 0.0;
  for (const std::size_t row :
       std::span(posterior.credible).first(std::min(posterior.credible.size(), kMostChecked))) {
    const Fit checked = check_fit(asked.observation, noise, asked.comparison.library.table.row(row));
    const double share = posterior.probability[row];
    chance += share * checked.chance;
    weight += share;
    if (!likeliest) likeliest = checked;
  }
  Fit fit = *likeliest;
  fit.chance = chance / weight;
  fit.explained = fit.chance >= kSmallestChance;
  if (fit.explained) fit.reason.clear();
  return fit;
}

Fit fit_of_known_bridge(const AskedReadings& asked, const NoiseEstimate& noise,
                        const std::vector<SensorResidual>& residuals) {
  Fit fit = average_fit(asked, noise);
  if (const auto doubt = check_signs(asked, fit.chance)) return *doubt;
  fit.suspects = suspects_among(residuals);
  return fit;
}

/// What nobody stated and would explain the readings, unless one of them disagrees with all others: then it
/// is left out instead (AnswerWithout).
std::optional<std::string> unstated_cause(const QuestionContext& asked,
                                          const std::vector<SensorResidual>& residuals) {
  const bool one_disagrees = std::ranges::any_of(residuals, &SensorResidual::disagrees);
  return one_disagrees ? std::nullopt : line_or_load_that_explains(asked);
}

Fit fit_of_unknown_bridge(const QuestionContext& asked, const std::vector<SensorResidual>& residuals) {
  Fit fit = check_fit(asked.believed);
  fit.suspects = suspects_among(residuals);
  if (!fit.explained) {
    if (const auto cause = unstated_cause(asked, residuals)) fit.reason += "; " + *cause;
    return fit;
  }
  if (const auto doubt = check_scatter(asked.question.bridge(), asked.believed)) return *doubt;
  if (const auto doubt = find_other(asked)) return *doubt;
  return fit;
}

std::vector<WeightedScene> likeliest_scenes(const Posterior& posterior) {
  std::vector<WeightedScene> scenes;
  for (const std::size_t row : posterior.credible)
    if (scenes.size() < kMostMixed) scenes.push_back({row, posterior.probability[row]});
  return scenes;
}

}  // namespace

Judgement judge_known_bridge(const AskedReadings& asked, std::size_t best) {
  const std::span<const double> prediction = asked.comparison.library.table.row(best);
  const NoiseEstimate noise = estimate_noise(asked.observation, prediction);
  const ErrorScales scales = scales_at(asked.observation, std::max(noise.level, kSmallestLevel));
  std::vector<SensorResidual> residuals = sensor_residuals(asked.observation, scales, prediction);
  Fit fit = fit_of_known_bridge(asked, noise, residuals);
  return {noise, std::move(fit), std::move(residuals)};
}

Judgement judge_unknown_bridge(const AskedReadings& asked, const UnknownBridgeQuestion& question,
                               const UnknownSettings& settings, const UnknownCase& likeliest) {
  const Observation& observation = asked.observation;
  const UnknownBridge& bridge = question.bridge();
  const NoiseEstimate noise{NoiseShape::gaussian, likeliest.level, observation.unknown_level,
                            observation.noise.floor};
  const std::vector<WeightedScene> scenes = likeliest_scenes(asked.posterior);
  if (scenes.empty())
    return {noise, {false, 0.0, "no scene can show them: each lacks a block that has a reading, or fell"}};
  BridgeAnswer answer{bridge, question.posterior(scenes)};
  const QuestionContext context{asked, question, settings, question.gaussians_at(likeliest.level),
                                answer.posterior};
  std::vector<SensorResidual> residuals = sensor_residuals(observation, bridge, answer.posterior);
  Fit fit = fit_of_unknown_bridge(context, residuals);
  return {noise, std::move(fit), std::move(residuals), std::move(answer)};
}

}  // namespace voussoir
