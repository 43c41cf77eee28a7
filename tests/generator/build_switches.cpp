#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "generator/build_switches.h"
#include "tests/support/bridges.h"
#include "tools/benchmarks/skips.h"

namespace voussoir {

TEST_CASE("A displacement beside a NaN is an infinite change, whichever of the two has it (written out)") {
  const double gone = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  using Values = std::vector<double>;
  CHECK(largest_change(Values{1.0, gone, 3.0}, Values{1.5, gone, 2.75}) == 0.5);
  CHECK(largest_change(Values{1.0, gone}, Values{1.0, 2.0}) == infinite);
  CHECK(largest_change(Values{1.0, 2.0}, Values{1.0, gone}) == infinite);
  CHECK(largest_change(Values{gone, 1.0}, Values{2.0, 1.0}) == infinite);
  CHECK(largest_change(Values{infinite}, Values{infinite}) == infinite);
  CHECK(largest_change(Values{1.0}, Values{1.0, 1.0}) == infinite);
}

TEST_CASE(
    "No skip changes an outcome, or a displacement by more than its stated bound (the scenes solved without "
    "it)",
    "[whole-build]") {
  const auto rows = measure_skips(read_bridge_file(test::example_bridge("small")), "singles;4,*+5,*;0,5+1,*");
  CHECK(rows.size() == build_switches().size() + 1);  // and fields that nobody asked for
  for (const SkipRow& row : rows) {
    INFO(row.name);
    CHECK(row.other_outcomes == 0);
    CHECK(row.largest_change <= row.stated_change);
  }
}

}  // namespace voussoir
