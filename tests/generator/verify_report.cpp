#include <catch2/catch.hpp>

#include "generator/verify.h"

namespace voussoir {

TEST_CASE("A report names scenes solved anew when there are any, and only then (wording written out)") {
  VerifyReport report;
  CHECK_THAT(to_text(report, "bridge.h5"), !Catch::Contains("recomputed"));
  report.recomputed = 12;
  report.largest_recomputed_difference = 2.5e-10;
  CHECK_THAT(to_text(report, "bridge.h5"),
             Catch::Contains("  recomputed  12 scenes, largest difference 2.5e-10 m\n"));
}

}  // namespace voussoir
