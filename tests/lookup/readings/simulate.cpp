#include "lookup/readings/simulate.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace voussoir;

TEST_CASE(
    "Simulated readings have the noise that was asked for, and silent sensors on missing blocks and by "
    "chance") {
  std::vector<double> truth(20'000, -2e-3);
  truth[7] = std::nan("");
  for (const NoiseShape shape :
       {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace, NoiseShape::student}) {
    Random random(12);
    const NoiseModel noise{shape, 0.05, 1e-5, 8.0, 0.1};
    const Measurements measured = simulate_readings(truth, noise, random);
    CHECK(measured.silent[7]);
    double sum = 0.0, square = 0.0;
    for (const double value : measured.displacement)
      if (!std::isnan(value)) {
        sum += value + 2e-3;
        square += (value + 2e-3) * (value + 2e-3);
      }
    const auto n = static_cast<double>(measured.count());
    const double sigma = 0.05 * 2e-3 + 1e-5;
    INFO(to_string(shape));
    CHECK(n / 20'000 == Approx(0.9).margin(0.01));
    CHECK(sum / n == Approx(0.0).margin(4.0 * sigma / std::sqrt(n)));
    CHECK(std::sqrt(square / n) == Approx(sigma * standard_deviation(shape)).epsilon(0.05));
  }
}
