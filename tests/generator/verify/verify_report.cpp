#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "generator/verify/verify.h"

namespace voussoir {

TEST_CASE("A report names scenes solved anew when there are any, and only then (wording written out)") {
  VerifyReport report;
  CHECK_THAT(to_text(report, "bridge.h5"), !Catch::Contains("recomputed"));
  report.recomputed = 12;
  report.largest_recomputed_difference = 2.5e-10;
  CHECK_THAT(to_text(report, "bridge.h5"),
             Catch::Contains("  recomputed  12 scenes, largest difference 2.5e-10 m\n"));
}

TEST_CASE("A part is not called whole, and what cannot be read is nothing of both (written out)") {
  VerifyReport report;
  CHECK_THAT(to_text(report, "a.h5"), Catch::StartsWith("a.h5: whole and consistent\n"));
  report.part = Shard{2, 3};
  CHECK_THAT(to_text(report, "a.h5"), Catch::StartsWith("a.h5: part 2/3 of a database and consistent\n"));
  CHECK(nlohmann::json::parse(to_json(report)).at("part") == "2/3");
  report = {};
  report.problems.push_back("ends too soon");
  CHECK_THAT(to_text(report, "a.h5"), Catch::StartsWith("a.h5: NOT in order\n"));
}

}  // namespace voussoir
