#include <catch2/catch.hpp>

#include "generator/build_switches.h"
#include "tests/support/bridges.h"
#include "tools/benchmark_skips.h"

namespace voussoir {

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
