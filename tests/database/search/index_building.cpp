#include "database/search/index_building.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace voussoir;

namespace {

constexpr std::size_t kPoints = 3;

/// One row whose largest displacement is `largest` [m], downwards or upwards.
SearchIndexData index_of_row(double largest, double side) {
  const std::vector<double> row = {0.0, side * largest, -0.25 * side * largest};
  return build_search_index(row, kPoints);
}

/// The finest unit there is, as a power of two metres: that of a row that does not move.
int finest_exponent() {
  return index_of_row(0.0, 1.0).exponent.front();
}

}  // namespace

TEST_CASE("Whole numbers of the index stay within their bound just below, at and above a unit's limit") {
  // Oracle: the largest size that the header promises, and the row itself, which its box has to hold.
  int unit = finest_exponent();
  for (int units = 0; units < 3; ++units) {
    int within = 0, above = 0;
    for (double beyond = -3.0; beyond <= 3.0; beyond += 0.25)
      for (const double side : {-1.0, 1.0}) {
        const double largest = std::ldexp(kFarthestPlace + beyond, unit);
        const SearchIndexData index = index_of_row(largest, side);
        INFO("limit of 2^" << unit << " m and " << beyond << ", side " << side);
        for (const auto* places : {&index.centre, &index.least, &index.most})
          for (const std::int16_t place : *places) REQUIRE(std::abs(std::int32_t{place}) <= kFarthestPlace);
        const double metres = std::ldexp(1.0, index.exponent.front());
        REQUIRE(index.least[1] * metres <= side * largest);
        REQUIRE(side * largest <= index.most[1] * metres);
        (index.exponent.front() == unit ? within : above) += 1;
      }
    CHECK(within > 0);  // the limit lies among what was tried
    CHECK(above > 0);
    unit = index_of_row(std::ldexp(2.0 * kFarthestPlace, unit), 1.0).exponent.front();  // the next coarser
  }
}
