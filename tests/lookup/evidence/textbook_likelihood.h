#pragma once
/// @file Likelihoods as textbooks write them, in extended precision: the oracle of the evidence.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lookup/readings/noise_model.h"
#include "tests/lookup/synthetic_library.h"

namespace voussoir::test {

inline constexpr std::array<NoiseShape, 4> kShapes = {NoiseShape::uniform, NoiseShape::gaussian,
                                                      NoiseShape::laplace, NoiseShape::student};
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Densities as textbooks write them, with a standard deviation (uniform: a half-width) of sigma.
inline long double density(NoiseShape shape, long double error, long double sigma, long double nu) {
  constexpr long double kPi = std::numbers::pi_v<long double>;
  if (shape == NoiseShape::uniform) return std::abs(error) <= sigma ? 0.5L / sigma : 0.0L;
  if (shape == NoiseShape::gaussian)
    return std::exp(-error * error / (2.0L * sigma * sigma)) / std::sqrt(2.0L * kPi * sigma * sigma);
  if (shape == NoiseShape::laplace) {
    const long double b = sigma / std::sqrt(2.0L);
    return std::exp(-std::abs(error) / b) / (2.0L * b);
  }
  const long double s = sigma * std::sqrt((nu - 2.0L) / nu);
  return std::tgamma((nu + 1) / 2) / (std::tgamma(nu / 2) * std::sqrt(nu * kPi) * s) *
         std::pow(1.0L + error * error / (nu * s * s), -(nu + 1) / 2);
}

/// The convolution of the instrument's uniform and the model's Gaussian error.
inline long double convolution(long double error, long double half_width, long double deviation) {
  const long double root = std::numbers::sqrt2_v<long double> * deviation;
  return (std::erfc((std::abs(error) - half_width) / root) -
          std::erfc((std::abs(error) + half_width) / root)) /
         (4.0L * half_width);
}

/// Standard deviation of the model's own error in a change at a point (database/records/model_error.h).
inline long double own_error(std::span<const double> prediction, std::span<const double> intact,
                             std::size_t i, const ModelError& error) {
  long double square = 0.0L;
  int count = 0;
  for (std::size_t k = 0; k < prediction.size(); ++k) {
    if (std::isnan(prediction[k])) continue;
    square += std::pow(static_cast<long double>(prediction[k]) - intact[k], 2);
    ++count;
  }
  return std::sqrt(std::pow(error.share * (prediction[i] - intact[i]), 2) +
                   error.common * error.common * square / count);
}

/// p(readings | row) for a stated level, the definition in noise_model.h word for word.
inline long double likelihood(const Measurements& measured, std::span<const double> prediction,
                              std::span<const double> intact, const NoiseModel& noise, NoiseShape shape,
                              long double level, const ModelError& error = {}) {
  long double product = 1.0L;
  for (std::size_t i = 0; i < prediction.size(); ++i) {
    if (std::isnan(measured.displacement[i])) continue;
    if (std::isnan(prediction[i])) return 0.0L;
    const long double own = measured.sigma[i];
    const long double origin = error == ModelError{} ? 0.0L : intact[i];  // changes count from there
    const long double movement = std::abs(prediction[i] - origin);
    const long double sigma = std::isnan(own) ? level * (movement + 1e-6L) + noise.floor : own;
    const long double model = own_error(prediction, intact, i, error);
    const long double difference = measured.displacement[i] - static_cast<long double>(prediction[i]);
    product *=
        shape == NoiseShape::uniform && model > 0.0L
            ? convolution(difference, sigma, model)
            : density(shape, difference, std::sqrt(sigma * sigma + model * model), noise.degrees_of_freedom);
  }
  return product;
}

/// Mean over log-uniform levels by a fine midpoint rule.
inline long double over_levels(const Measurements& measured, std::span<const double> prediction,
                               std::span<const double> intact, const NoiseModel& noise, NoiseShape shape,
                               const ModelError& error = {}, int kSteps = 40'000) {
  const long double range = std::log(static_cast<long double>(kLargestLevel) / kSmallestLevel);
  long double sum = 0.0L;
  for (int i = 0; i < kSteps; ++i)
    sum += likelihood(measured, prediction, intact, noise, shape,
                      kSmallestLevel * std::exp(range * (i + 0.5L) / kSteps), error);
  return sum / kSteps;
}

inline Measurements readings_of(const SyntheticLibrary& library, std::size_t row, double level,
                                std::uint64_t seed) {
  Random random(seed);
  return library.measure(row, level, NoiseShape::uniform, random);
}

}  // namespace voussoir::test
