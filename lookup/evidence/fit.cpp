#include "lookup/evidence/fit.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

constexpr double kSmallestChance = 1e-4;  // a scene explains readings whose fit is at least this likely
constexpr double kSuspiciousLevel = 0.3;  // an estimated noise above this share means that nothing fits
constexpr double kPerfectLevel = 1e-4;    // below it residuals are rounding, and their pattern means nothing
constexpr std::size_t kFewestForPattern = 10;
constexpr double kDisagreement = 8.0;  // times the median error: rare even among Laplace's wide tails
constexpr std::size_t kFewestForDisagreement = 5;

/// The errors of the sensors that can move.
std::vector<double> errors_of(const std::vector<SensorResidual>& residuals) {
  std::vector<double> result;
  for (const SensorResidual& residual : residuals)
    if (!std::isnan(residual.error)) result.push_back(residual.error);
  return result;
}

/// How large an error must be to disagree with the others.
double limit_of_agreement(const std::vector<SensorResidual>& residuals) {
  std::vector<double> sizes = errors_of(residuals);
  for (double& size : sizes) size = std::abs(size);
  if (sizes.size() < kFewestForDisagreement) return std::numeric_limits<double>::infinity();
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return kDisagreement * *middle;
}

double lower_tail(double standard_normal) {
  return boost::math::cdf(boost::math::normal(), standard_normal);
}

/// Sum of -log of a Beta(nu/2, 1/2) variate for each reading, against its normal limit.
double student_chance(const std::vector<double>& errors, double nu) {
  const auto n = static_cast<double>(errors.size());
  double sum = 0.0;
  for (const double z : errors) sum += std::log1p(z * z / (nu - 2.0));
  const double mean = boost::math::digamma((nu + 1.0) / 2.0) - boost::math::digamma(nu / 2.0);
  const double variance = boost::math::trigamma(nu / 2.0) - boost::math::trigamma((nu + 1.0) / 2.0);
  return lower_tail(-(sum - n * mean) / std::sqrt(n * variance));
}

double chance_at_stated_level(const std::vector<double>& errors, NoiseShape shape,
                              double degrees_of_freedom) {
  const auto n = static_cast<double>(errors.size());
  double absolute = 0.0, square = 0.0, largest = 0.0;
  for (const double z : errors) {
    absolute += std::abs(z);
    square += z * z;
    largest = std::max(largest, std::abs(z));
  }
  switch (shape) {
    case NoiseShape::uniform:
      return largest <= 1.0 + 1e-9 ? 1.0 : 0.0;
    case NoiseShape::laplace:
      return boost::math::gamma_q(n, std::sqrt(2.0) * absolute);
    case NoiseShape::student:
      return student_chance(errors, degrees_of_freedom);
    default:
      return boost::math::gamma_q(n / 2.0, square / 2.0);
  }
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

std::vector<SensorResidual> sensor_residuals(const Observation& observation, const ErrorScales& scales,
                                             std::span<const double> prediction) {
  const std::vector<double> sigma = error_scales(observation, scales, prediction);
  std::vector<SensorResidual> result;
  for (std::size_t point = 0; point < prediction.size(); ++point) {
    const double reading = observation.displacement[point];
    if (!std::isnan(reading))
      result.push_back({point, reading, prediction[point], sigma[point],
                        (reading - prediction[point]) / sigma[point], false});
  }
  const double limit = limit_of_agreement(result);
  for (SensorResidual& residual : result)
    residual.disagrees = limit > 0.0 && std::abs(residual.error) > limit;
  return result;
}

Fit check_fit(const std::vector<SensorResidual>& residuals, const NoiseEstimate& noise,
              double degrees_of_freedom) {
  const std::vector<double> errors = errors_of(residuals);
  if (!noise.estimated) {
    const double chance = chance_at_stated_level(errors, noise.shape, degrees_of_freedom);
    return {chance >= kSmallestChance, chance,
            chance >= kSmallestChance ? "" : "the scatter exceeds the stated noise"};
  }
  if (noise.level * standard_deviation(noise.shape) > kSuspiciousLevel)
    return {false, 0.0, "the scatter is too large to be noise"};
  if (noise.level < kPerfectLevel || errors.size() < kFewestForPattern) return {};
  const double chance = chance_of_pattern(errors);
  return {chance >= kSmallestChance, chance,
          chance >= kSmallestChance ? "" : "neighbouring sensors deviate together, as noise does not"};
}

}  // namespace voussoir
