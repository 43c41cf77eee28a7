#include "lookup/readings/observation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/not_a_number.h"
#include "lookup/readings/common_variance.h"
#include "lookup/readings/noise_scale.h"
#include "lookup/readings/stated_sigmas.h"

namespace voussoir {
namespace {

constexpr double kClamped = 1e-12;  // [m] points that never move more are held by a support

/// True if a point moves neither in the intact bridge nor in a single.
bool is_held(const SceneTable& table, std::size_t point) {
  for (std::size_t row = 0; row < table.rows && table.scene(row).missing() <= 1; ++row)
    if (std::abs(table.row(row)[point]) > kClamped) return false;
  return true;
}

/// Takes the readings that say something, with their instruments' errors.
void add_readings(const Comparison& comparison, Observation& observation) {
  const Measurements& measured = comparison.measured;
  for (std::size_t i = 0; i < measured.displacement.size(); ++i) {
    if (std::isnan(measured.displacement[i])) continue;
    const bool own = !std::isnan(measured.sigma[i]), held = is_held(comparison.library.table, i);
    if (held && !own) continue;
    observation.moving += held ? 0 : 1;
    observation.reading[i] = measured.displacement[i];
    observation.share[i] = own ? 0.0 : 1.0;
    observation.floor[i] = own ? measured.sigma[i] : observation.noise.floor;
    observation.own_sigmas |= own;
    observation.unknown_level |= !own && !observation.noise.relative;
    ++observation.count;
  }
}

void add_model_error(const Comparison& comparison, Observation& observation) {
  const ModelError& error = comparison.model_error;
  observation.error_share = error.share;
  observation.error_common = error.common;
  if (is_change(comparison.kind))
    observation.origin = observation.intact;
  else
    for (std::size_t i = 0; i < error.intact.size(); ++i)
      observation.own_variance[i] = error.intact[i] * error.intact[i];
}

}  // namespace

std::vector<std::size_t> Observation::channels_read() const {
  std::vector<std::size_t> channels;
  for (std::size_t i = 0; i < reading.size(); ++i)
    if (!std::isnan(reading[i])) channels.push_back(i);
  return channels;
}

bool Observation::has_model_error() const {
  return error_share > 0.0 || error_common > 0.0 ||
         std::any_of(own_variance.begin(), own_variance.end(), [](double v) { return v > 0.0; });
}

Observation observe(const Comparison& comparison, const NoiseModel& noise, const Nuisance& nuisance) {
  const std::span<const double> intact = intact_predictions(comparison.library.table);
  const std::vector<double> zeros(intact.size(), 0.0);
  Observation result;
  result.displacement = comparison.measured.displacement;
  result.reading.assign(intact.size(), kNan);
  result.share = zeros;
  result.floor.assign(intact.size(), 1.0);
  result.intact = {intact.begin(), intact.end()};
  result.origin = zeros;
  result.own_variance = zeros;
  result.silent = comparison.measured.silent;
  result.noise = noise_of(comparison.measured, noise);
  add_readings(comparison, result);
  add_model_error(comparison, result);
  if ((nuisance.datum > 0.0 || nuisance.tilt > 0.0) && result.noise.shape != NoiseShape::gaussian)
    throw InputError("an unknown datum or tilt needs Gaussian noise, expected --noise-model gaussian");
  const bool is_absolute = !is_change(comparison.kind) && result.has_model_error();
  result.unknown_scale = std::max(nuisance.scale, is_absolute ? kLeastUnknownScale : 0.0);
  result.levelling = levelling_columns(comparison, comparison.measured, nuisance);
  result.datum_stated = nuisance.datum > 0.0;
  result.tilt_stated = nuisance.tilt > 0.0;
  return result;
}

void require_readings(const Observation& observation) {
  if (observation.moving > 0) return;
  throw InputError("no reading at a control point that can move, expected at least one");
}

ErrorScales scales_at(const Observation& observation, double level) {
  ErrorScales result{observation.share, observation.floor, 1.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < result.slope.size(); ++i) {
    result.slope[i] *= level;
    result.offset[i] += result.slope[i] * kSmallestMovement;
    if (std::isnan(observation.reading[i])) continue;
    const double movement = std::abs(observation.intact[i] - observation.origin[i]);
    const double scale = noise_scale(result.slope[i], result.offset[i], movement);
    sum += scale * scale + observation.own_variance[i];
  }
  if (observation.count > 0) result.unit = std::sqrt(sum / static_cast<double>(observation.count));
  return result;
}

ExpectedErrors expected_errors(const Observation& observation, const ErrorScales& scales,
                               std::span<const double> prediction) {
  ExpectedErrors result{std::vector<double>(prediction.size(), kNan),
                        std::vector<double>(prediction.size(), kNan)};
  const double common = common_variance(observation.intact, observation.error_common, prediction);
  for (std::size_t i = 0; i < prediction.size(); ++i) {
    if (std::isnan(observation.reading[i])) continue;
    result.instrument[i] =
        noise_scale(scales.slope[i], scales.offset[i], std::abs(prediction[i] - observation.origin[i]));
    result.model[i] = std::sqrt(model_variance(observation.own_variance[i] + common,
                                               observation.error_share * observation.error_share,
                                               prediction[i] - observation.intact[i]));
  }
  return result;
}

}  // namespace voussoir
