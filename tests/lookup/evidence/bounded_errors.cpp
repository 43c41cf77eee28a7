/// @file The density of a bounded instrument's error beside the model's, against numerical convolution in
/// extended precision.

#include "lookup/evidence/bounded_errors.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/lookup/synthetic_library.h"

using namespace voussoir;

namespace {

/// log of (1 / 2b) times the integral of the Gaussian over [e - b, e + b], its peak there taken out.
long double log_convolution(long double error, long double half_width, long double deviation) {
  const long double nearest = std::max(0.0L, std::abs(error) - half_width) / deviation;
  const auto relative = [&](long double x) {
    const long double z = (std::abs(error) - x) / deviation;
    return std::exp(0.5L * (nearest * nearest - z * z));
  };
  const long double from = std::max(-half_width, std::abs(error) - (nearest + 12.0L) * deviation);
  const long double to = std::min(half_width, std::abs(error) + 12.0L * deviation);
  const long double integral =
      boost::math::quadrature::gauss_kronrod<long double, 61>::integrate(relative, from, to, 8, 1e-9L);
  return std::log(integral) - 0.5L * nearest * nearest -
         std::log(2.0L * half_width * deviation * std::sqrt(2.0L * std::numbers::pi_v<long double>));
}

}  // namespace

TEST_CASE("The density of bounded errors beside Gaussian ones is their convolution") {
  int compared = 0;
  for (const double share : {1e-9, 1e-3, 0.0199, 0.0201, 0.1, 0.3, 1.0, 7.0, 300.0})  // bound over deviation
    for (const double beyond : {-250.0, -9.0, -3.0, -0.4, 0.0, 0.4, 3.0, 9.0, 25.0}) {
      const double deviation = 2e-6, half_width = share * deviation;
      const double error = half_width + beyond * deviation;
      if (error < 0.0) continue;
      INFO(share << " " << beyond);
      const auto exact = static_cast<double>(log_convolution(error, half_width, deviation));
      // The tail's fit is good to 1.2e-7; the difference of two tails 0.04 deviations apart is a fiftieth of
      // them.
      CHECK(log_bounded_density(error, half_width, deviation) == Approx(exact).epsilon(1e-12).margin(1e-5));
      CHECK(log_bounded_density(-error, half_width, deviation) ==
            log_bounded_density(error, half_width, deviation));
      ++compared;
    }
  CHECK(compared > 50);
}

TEST_CASE("The chance of an error is what its density leaves beyond it") {
  for (const double half_width : {1e-7, 1e-5, 1e-4}) {
    const double deviation = 1e-5;
    double beyond = 0.0;  // from far outside towards zero, both signs
    constexpr int kSteps = 20'000;
    const double step = (half_width + 10.0 * deviation) / kSteps;
    for (int i = kSteps - 1; i >= 0; --i) {
      beyond += 2.0 * step * std::exp(log_bounded_density((i + 0.5) * step, half_width, deviation));
      if (i % 1000 == 0)
        CHECK(chance_of_bounded_error(i * step, half_width, deviation) == Approx(beyond).margin(1e-5));
    }
  }
}

TEST_CASE(
    "The highest likelihoods of bounded errors are nowhere below the likelihoods, nor far above the "
    "truth's") {
  const test::SyntheticLibrary library(2, 4);
  const auto rows = test::all_rows(library.table);
  Random random(11);
  constexpr std::size_t kTruth = 3;
  constexpr double kNoise = 0.05;
  int possible = 0;
  for (const double level : {1e-4, 0.01, 2.0 * kNoise})
    for (const double scale : {0.0, 0.02}) {
      const Measurements measured = library.measure(kTruth, kNoise, NoiseShape::uniform, random);
      const Observation observation =
          library.observe(measured, {NoiseShape::uniform, level}, {scale}, {0.05, 0.02, {}});
      const ErrorScales scales = scales_at(observation, level);
      const auto exact = log_bounded_likelihoods(observation, scales, library.table, rows);
      const auto highest = highest_bounded_likelihoods(observation, scales, library.table, rows);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        REQUIRE(std::isnan(highest[i]) == std::isnan(exact[i]));
        if (std::isnan(exact[i])) continue;
        ++possible;
        CHECK(highest[i] >= exact[i] - 1e-6);
        CHECK(std::isfinite(highest[i]));
      }
    }
  CHECK(possible > 50);
}
