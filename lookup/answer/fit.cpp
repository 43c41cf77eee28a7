#include "lookup/answer/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/median.h"
#include "core/not_a_number.h"
#include "lookup/evidence/bounded_errors.h"
#include "lookup/evidence/chi_square.h"
#include "lookup/evidence/nuisance_likelihood.h"
#include "lookup/evidence/row_statistics.h"
#include "lookup/evidence/scale_fit.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/common_variance.h"

namespace voussoir {
namespace {

// Chosen, not tuned.
constexpr double kSuspiciousLevel = 0.3;  // an estimated noise above this share means that nothing fits
constexpr double kPerfectLevel = 1e-4;    // below it residuals are rounding, and their pattern means nothing
constexpr std::size_t kFewestForPattern = 10;  // errors, for the normal limit of von Neumann's ratio
constexpr double kDisagreement = 8.0;          // times the median error: rare even among Laplace's wide tails
constexpr std::size_t kFewestForDisagreement = 5;  // errors, of which the median says how large they are
// Of what the model says, to be believed: docs/uncertainty.md ("The model turned round") says what it finds.
constexpr double kLeastTimes = 0.2, kMostTimes = 5.0;

/// The errors of the sensors that can move.
std::vector<double> errors_of(const std::vector<SensorResidual>& residuals) {
  std::vector<double> result;
  for (const SensorResidual& residual : residuals)
    if (!std::isnan(residual.error)) result.push_back(residual.error);
  return result;
}

void mark_disagreement(std::vector<SensorResidual>& residuals) {
  const double limit = limit_of_agreement(residuals);
  for (SensorResidual& residual : residuals)
    residual.disagrees = limit > 0.0 && std::abs(residual.error) > limit;
}

double lower_tail(double standard_normal) {
  return boost::math::cdf(boost::math::normal(), standard_normal);
}

/// The chance of an error at least as large as this one.
double chance_of_error(NoiseShape shape, double error, double instrument, double model, double nu) {
  if (shape == NoiseShape::student) {
    const double scaled = std::abs(error) / std::hypot(instrument, model) * std::sqrt(nu / (nu - 2.0));
    return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(nu), scaled));
  }
  if (model > 0.0) return chance_of_bounded_error(error, instrument, model);
  return std::max(0.0, 1.0 + kBoundTolerance - std::abs(error) / instrument);
}

/// Fisher's method: -2 sum log p_i has a chi square distribution if all p_i are even between 0 and 1.
double fisher_chance(const Observation& observation, NoiseShape shape, const ExpectedErrors& expected,
                     std::span<const double> prediction, const RowTerms& row) {
  double sum = 0.0;
  for (std::size_t i = 0; i < prediction.size(); ++i) {
    if (std::isnan(observation.reading[i])) continue;
    const double movement = prediction[i] - observation.origin[i];
    const double error = observation.reading[i] - observation.origin[i] - row.factor * movement;
    const double model = std::hypot(expected.model[i], std::sqrt(row.variance) * movement);
    sum -= std::log(
        chance_of_error(shape, error, expected.instrument[i], model, observation.noise.degrees_of_freedom));
  }
  return std::isfinite(sum) ? boost::math::gamma_q(static_cast<double>(observation.count), sum) : 0.0;
}

double chance_at_stated_level(const Observation& observation, const NoiseEstimate& noise,
                              std::span<const double> prediction) {
  constexpr std::array<std::size_t, 1> kRow = {0};
  const SceneTable table = table_of_one_row(prediction);
  const auto n = static_cast<double>(observation.count);
  const double level = std::max(noise.level, kSmallestLevel);
  const ErrorScales scales = scales_at(observation, level);
  if (observation.has_levelling()) {
    const RowStatistics row = nuisance_statistics(observation, level, table, kRow).row(0);
    return std::isnan(row.sum_absolute) ? 0.0 : chi_square_chance(row.sum_square, n);
  }
  const RowStatistics row = table_statistics(observation, scales, table, kRow).row(0);
  if (std::isnan(row.sum_absolute)) return 0.0;
  if (noise.shape == NoiseShape::gaussian) return chi_square_chance(row.sum_square + row.scale_square, n);
  if (noise.shape == NoiseShape::laplace)
    return boost::math::gamma_q(n, std::numbers::sqrt2 * row.sum_absolute);
  const double instrument_variance = noise.shape == NoiseShape::uniform ? kBoundedVariance : 1.0;
  const std::vector<double> common =
      common_variances(observation.intact, observation.error_common, table, kRow);
  const std::vector<ScaleFit> fits =
      scale_fits(observation, scales, table, kRow, common, instrument_variance);
  return fisher_chance(observation, noise.shape, expected_errors(observation, scales, prediction), prediction,
                       row_terms(common, fits).front());
}

/// Chance that independent errors follow their neighbours as closely as these: von Neumann's ratio, normal
/// limit.
double chance_of_pattern(const std::vector<double>& errors) {
  const auto n = static_cast<double>(errors.size());
  double square = 0.0, differences = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    square += errors[i] * errors[i];
    if (i > 0) differences += (errors[i] - errors[i - 1]) * (errors[i] - errors[i - 1]);
  }
  if (square == 0.0) return 1.0;
  const double mean = 2.0 * (n - 1.0) / n;
  const double deviation = 2.0 * std::sqrt(n - 2.0) / n;
  return lower_tail((differences / square - mean) / deviation);
}

}  // namespace

double limit_of_agreement(const std::vector<SensorResidual>& residuals) {
  std::vector<double> sizes = errors_of(residuals);
  for (double& size : sizes) size = std::abs(size);
  if (sizes.size() < kFewestForDisagreement) return std::numeric_limits<double>::infinity();
  return kDisagreement * median(sizes);
}

std::vector<SensorResidual> sensor_residuals(const Observation& observation, const ErrorScales& scales,
                                             std::span<const double> prediction) {
  const ExpectedErrors expected = expected_errors(observation, scales, prediction);
  std::vector<double> deviations;
  for (std::size_t point = 0; point < prediction.size(); ++point)
    deviations.push_back(std::hypot(expected.instrument[point], expected.model[point]));
  const Eigen::ArrayXd nuisances = fitted_nuisances(observation, prediction, deviations);
  std::vector<SensorResidual> result;
  for (std::size_t point = 0; point < prediction.size(); ++point) {
    const double reading = observation.displacement[point], scale = deviations[point];
    if (std::isnan(reading)) continue;
    const double predicted = prediction[point] + nuisances[static_cast<Eigen::Index>(point)];
    result.push_back({point, reading, predicted, scale, (reading - predicted) / scale, false});
  }
  mark_disagreement(result);
  return result;
}

std::vector<SensorResidual> sensor_residuals(const Observation& observation, const UnknownBridge& bridge,
                                             const BridgePosterior& posterior) {
  std::vector<SensorResidual> result;
  for (std::size_t point = 0; point < observation.displacement.size(); ++point)
    if (const double reading = observation.displacement[point]; !std::isnan(reading))
      result.push_back({point, reading, reading, kNan, kNan, false});
  for (std::size_t k = 0; k < bridge.rows.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (bridge.rows[k].after == 0.0) continue;
    const auto found = std::find_if(result.begin(), result.end(), [&](const SensorResidual& residual) {
      return residual.point == bridge.rows[k].channel;
    });
    found->predicted = found->reading - posterior.beside[row];
    found->scale = posterior.spread[row];
    found->error = posterior.beside[row] / posterior.spread[row];
  }
  mark_disagreement(result);
  return result;
}

Fit check_fit(const Observation& observation, const NoiseEstimate& noise,
              std::span<const double> prediction) {
  if (!noise.estimated) {
    const double chance = chance_at_stated_level(observation, noise, prediction);
    return {chance >= kSmallestChance, chance,
            chance >= kSmallestChance ? "" : "the scatter exceeds the stated noise"};
  }
  const ErrorScales scales = scales_at(observation, std::max(noise.level, kSmallestLevel));
  const std::vector<double> errors = errors_of(sensor_residuals(observation, scales, prediction));
  if (noise.level * standard_deviation(noise.shape) > kSuspiciousLevel)
    return {false, 0.0, "the scatter is too large to be noise"};
  if (noise.level < kPerfectLevel || errors.size() < kFewestForPattern) return {};
  const double chance = chance_of_pattern(errors);
  return {chance >= kSmallestChance, chance,
          chance >= kSmallestChance ? "" : "neighbouring sensors deviate together, as noise does not"};
}

Fit check_fit(const BridgePosterior& posterior) {
  if (posterior.chance >= kSmallestChance) return {true, posterior.chance, ""};
  return {false, posterior.chance, "the scatter exceeds what instruments and an uncertain bridge explain"};
}

std::optional<Fit> check_sizes(const BridgePosterior& posterior) {
  const auto is_wrong = [](double times) { return times < kLeastTimes || times > kMostTimes; };
  constexpr const char* kRemedy = "are the readings' signs, units and order of epochs right?";
  if (is_wrong(posterior.times_movement))
    return Fit{false, posterior.chance,
               fmt::format("the bridge would move {:.2g} times as much as the model does; {}",
                           posterior.times_movement, kRemedy)};
  if (is_wrong(posterior.times_signal))
    return Fit{false, posterior.chance,
               fmt::format("the missing blocks would change {:.2g} times what they change in the model; {}",
                           posterior.times_signal, kRemedy)};
  return std::nullopt;
}

std::vector<SensorResidual> disagreeing(const std::vector<SensorResidual>& residuals) {
  std::vector<SensorResidual> odd;
  std::ranges::copy_if(residuals, std::back_inserter(odd), &SensorResidual::disagrees);
  std::ranges::stable_sort(odd, std::ranges::greater{},
                           [](const SensorResidual& sensor) { return std::abs(sensor.error); });
  return odd;
}

}  // namespace voussoir
