/// @file Oracle: a stable sort of all places.

#include "lookup/evidence/largest_places.h"

#include <catch2/catch.hpp>
#include <limits>

namespace voussoir {

TEST_CASE("The largest places are the first of a stable sort, however many are wanted") {
  constexpr double kLeast = -std::numeric_limits<double>::infinity();
  const std::vector<double> values = {2.0, kLeast, 7.0, 2.0, 7.0, -1.0, kLeast, 2.0};
  std::vector<std::size_t> sorted = {0, 1, 2, 3, 4, 5, 6, 7};
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  for (std::size_t count = 0; count < 10; ++count) {
    const std::size_t kept = std::min(count, values.size());
    const std::vector<std::size_t> first(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(kept));
    CHECK(largest_places(values, count) == first);
  }
}

TEST_CASE("The largest of some places leave the others out, in whatever order they come") {
  const std::vector<double> values = {2.0, 9.0, 7.0, 2.0, 7.0};
  CHECK(largest_places({4, 3, 2, 0}, values, 3) == std::vector<std::size_t>{2, 4, 0});
}

}  // namespace voussoir
