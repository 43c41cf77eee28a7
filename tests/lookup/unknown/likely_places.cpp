/// @file Oracle: all values in order, summed up in extended precision.

#include "lookup/unknown/likely_places.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.h"
#include "tests/lookup/evidence/textbook_likelihood.h"

namespace voussoir {
namespace {

using test::kInfinity;

constexpr double kBin = 1.0 / 8.0;  // of the histogram

/// The value with which, in ascending order, the sum of exponentials first exceeds exp(log_rest).
double first_that_matters(std::vector<double> values, double log_rest) {
  std::sort(values.begin(), values.end());
  long double sum = 0.0L;
  for (const double value : values) {
    sum += std::exp(static_cast<long double>(value));
    if (sum > std::exp(static_cast<long double>(log_rest))) return value;
  }
  return kInfinity;
}

}  // namespace

TEST_CASE("What is not likely sums up to the rest at most, and to a bin less at least") {
  Random random(1);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<double> values;
    const double range = 60.0 * random.uniform();
    for (int i = 0; i < 1 + repeat * 20; ++i) values.push_back(range * (random.uniform() - 0.7));
    const double log_rest = 20.0 * (random.uniform() - 0.7);
    const std::vector<std::size_t> likely = likely_places(values, log_rest, kInfinity);
    REQUIRE(std::is_sorted(likely.begin(), likely.end()));
    std::vector<bool> is_likely(values.size(), false);
    for (const std::size_t place : likely) is_likely[place] = true;
    const double surely = first_that_matters(values, log_rest),
                 perhaps = first_that_matters(values, log_rest - kBin) - kBin;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] >= surely) REQUIRE(is_likely[i]);
      if (values[i] < perhaps) REQUIRE(!is_likely[i]);
    }
  }
}

TEST_CASE(
    "Of some places others do not count, what is not finite is not summed up, and what has to stay does") {
  const std::vector<double> values = {0.0, std::nan(""), -kInfinity, kInfinity, -20.0, 3.0, -5.0};
  CHECK(likely_places(values, -1.0, kInfinity) == std::vector<std::size_t>{0, 1, 3, 5});
  CHECK(likely_places(values, -1.0, -10.0) == std::vector<std::size_t>{0, 1, 3, 5, 6});
  const std::vector<std::size_t> some = {6, 4, 0};
  CHECK(likely_places(some, values, -1.0, kInfinity) == std::vector<std::size_t>{0});
  CHECK(likely_places(values, -kInfinity, kInfinity) == std::vector<std::size_t>{0, 1, 3, 4, 5, 6});
}

}  // namespace voussoir
