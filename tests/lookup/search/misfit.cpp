#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "lookup/search/misfit.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The sum as the paper's Eq. 1 writes it, in extended precision.
long double plain_sum(std::span<const double> readings, std::span<const double> prediction) {
  long double sum = 0.0L;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (!std::isnan(readings[i])) sum += std::abs(static_cast<long double>(readings[i]) - prediction[i]);
  return sum;
}

}  // namespace

TEST_CASE("The sum of differences is that of a plain loop, for every number of points") {
  Random random(3);
  for (std::size_t points = 1; points <= 40; ++points) {
    std::vector<double> readings(points), prediction(points);
    for (double& value : readings) value = random.below(4) == 0 ? kNan : random.gaussian();
    for (double& value : prediction) value = random.gaussian();
    CHECK(sum_of_differences(readings, prediction) ==
          Approx(static_cast<double>(plain_sum(readings, prediction))).epsilon(1e-14));
  }
}

TEST_CASE("The misfit of a perfect match is the logarithm of the guard") {
  const std::vector<double> readings = {1e-3, kNan, -2e-3};
  CHECK(misfit(readings, readings) == Approx(std::log(1e-16)));
  CHECK(misfit_of(1.0) == Approx(0.0).margin(1e-15));
}

TEST_CASE("A reading on a block that the scene lacks makes the scene impossible, a lost sensor does not") {
  const std::vector<double> prediction = {1e-3, kNan, -2e-3};
  CHECK(std::isinf(misfit(std::vector<double>{1e-3, 0.5e-3, kNan}, prediction)));
  CHECK(misfit(std::vector<double>{1e-3, kNan, -2e-3}, prediction) == Approx(std::log(1e-16)));
}

TEST_CASE("The sums of rows of a table are bit for bit those of each, in their order") {
  const test::SyntheticLibrary library(4, 7);
  Random random(5);
  const Measurements measured = library.measure(100, 0.05, NoiseShape::uniform, random);
  const std::vector<std::size_t> rows = {library.table.rows - 1, 0, 3, 3};
  const std::vector<double> sums = sums_of_differences(measured.displacement, library.table, rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    REQUIRE(sums[i] == sum_of_differences(measured.displacement, library.table.row(rows[i])));
}
