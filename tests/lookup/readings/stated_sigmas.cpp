#include "lookup/readings/stated_sigmas.h"

#include <catch2/catch.hpp>

#include "core/error.h"

using namespace voussoir;

namespace {

/// Readings of which the first `stated` state their sigma, and a point without a sensor.
Measurements with_sigmas(std::size_t stated) {
  Measurements measured = no_measurements(4);
  for (std::size_t i = 0; i < 3; ++i) measured.displacement[i] = 1e-3;
  for (std::size_t i = 0; i < stated; ++i) measured.sigma[i] = 2e-5;
  return measured;
}

}  // namespace

TEST_CASE("A sigma is a positive number of millimetres, with its unit or without") {
  for (const char* const text : {"0.02", "0.02mm", "0.02 mm", "2e-2"})
    CHECK(parse_sigma(text) == Approx(2e-5));
  for (const char* const text :
       {"0", "-0.02", "0.02m", "0,02", "nan", "inf", "", "mm", "1e7", "5%", "2e-5", "10001"})
    CHECK_THROWS_AS(parse_sigma(text), InputError);
}

TEST_CASE("Where every reading states its sigma the noise is Gaussian and nothing relative is unknown") {
  const NoiseModel noise = noise_of(with_sigmas(3), {});
  CHECK(noise.relative == 0.0);
  CHECK(noise.shape == NoiseShape::gaussian);
  CHECK_FALSE(noise_of(with_sigmas(2), {}).relative.has_value());
  CHECK(noise_of(with_sigmas(2), {}).shape == NoiseShape::automatic);
}

TEST_CASE("A stated shape of the noise stays, a level where there is a reading that it is of") {
  CHECK(noise_of(with_sigmas(3), {NoiseShape::laplace, std::nullopt}).shape == NoiseShape::laplace);
  CHECK(noise_of(with_sigmas(2), {NoiseShape::automatic, 0.05}).relative == 0.05);
  CHECK(noise_of(with_sigmas(2), {NoiseShape::automatic, 0.05}).shape == NoiseShape::automatic);
  CHECK(noise_of(with_sigmas(3), {NoiseShape::automatic, 0.05}).relative == 0.0);
  CHECK(noise_of(with_sigmas(3), {NoiseShape::automatic, 0.05}).shape == NoiseShape::gaussian);
}
