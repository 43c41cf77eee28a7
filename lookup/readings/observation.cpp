#include "lookup/readings/observation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kClamped = 1e-12;  // [m] points that move less are held by a support

}  // namespace

Observation observe(const Measurements& measurements, std::span<const double> intact,
                    const NoiseModel& noise) {
  const std::size_t points = measurements.displacement.size();
  const auto stated = [](double sigma) { return !std::isnan(sigma); };
  Observation result{.displacement = measurements.displacement,
                     .reading = std::vector<double>(points, kNan),
                     .share = std::vector<double>(points, 0.0),
                     .floor = std::vector<double>(points, 1.0),
                     .intact = {intact.begin(), intact.end()},
                     .origin = std::vector<double>(points, 0.0),
                     .own_error = std::vector<double>(points, 0.0),
                     .silent = measurements.silent,
                     .noise = noise,
                     .own_sigmas = std::any_of(measurements.sigma.begin(), measurements.sigma.end(), stated)};
  for (std::size_t i = 0; i < points; ++i) {
    if (std::isnan(measurements.displacement[i]) || std::abs(intact[i]) <= kClamped) continue;
    const bool own = stated(measurements.sigma[i]);
    result.reading[i] = measurements.displacement[i];
    result.share[i] = own ? 0.0 : 1.0;
    result.floor[i] = own ? measurements.sigma[i] : noise.floor;
    ++result.count;
  }
  return result;
}

Observation observe(const Comparison& comparison, std::span<const double> intact, const NoiseModel& noise) {
  Observation result = observe(comparison.measured, intact, noise);
  result.error_share = comparison.model_error.share;
  result.error_common = comparison.model_error.common;
  if (is_change(comparison.kind))
    result.origin = result.intact;
  else if (!comparison.model_error.intact.empty())
    result.own_error = comparison.model_error.intact;
  return result;
}

void require_readings(const Observation& observation) {
  if (observation.count == 0)
    throw InputError("no reading at a control point that can move, expected at least one");
}

ErrorScales scales_at(const Observation& observation, double level) {
  ErrorScales result{observation.share, observation.floor, 1.0};
  double sum_log_scale = 0.0;
  for (std::size_t i = 0; i < result.slope.size(); ++i) {
    result.slope[i] *= level;
    result.offset[i] += result.slope[i] * kSmallestMovement;
    if (!std::isnan(observation.reading[i]))
      sum_log_scale +=
          std::log(noise_scale(result.slope[i], result.offset[i], std::abs(observation.intact[i])));
  }
  if (observation.count > 0) result.unit = std::exp(sum_log_scale / static_cast<double>(observation.count));
  return result;
}

std::vector<double> error_scales(const Observation& observation, const ErrorScales& scales,
                                 std::span<const double> prediction) {
  std::vector<double> result(prediction.size(), kNan);
  for (std::size_t i = 0; i < prediction.size(); ++i)
    if (!std::isnan(observation.reading[i]))
      result[i] = noise_scale(scales.slope[i], scales.offset[i], std::abs(prediction[i]),
                              observation.noise.model_error, std::abs(prediction[i] - observation.intact[i]));
  return result;
}

}  // namespace voussoir
