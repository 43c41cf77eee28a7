#include <catch2/catch.hpp>

#include "core/statics/mechanism.h"
#include "database/records/database.h"
#include "generator/build.h"
#include "generator/summary.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

struct Built {
  std::filesystem::path path;
  BuildSummary summary;
  Database database() const { return Database::open(path); }
};

/// The small bridge, or the reference bridge with one arch block gone in most scenes.
Built build(const test::TemporaryFolder& folder, const BridgeFile& bridge, const std::string& scenes,
            bool collapse_fields) {
  Progress quiet(Progress::Mode::quiet);
  BuildRequest request;
  request.bridge = bridge;
  request.output = folder / (collapse_fields ? "field.h5" : "outcome.h5");
  request.scenes = scenes;
  request.rules.collapse_fields = collapse_fields;
  request.known_bridge = true;
  BuildSummary summary = build_database(request, quasi_static_with(collapse_fields), quiet);
  return {request.output, std::move(summary)};
}

/// Every scene falls or stands in both, and in the same way.
void check_same_outcomes(const Built& fields, const Built& outcomes) {
  const Database with = fields.database();
  const Database without = outcomes.database();
  REQUIRE(with.rows() == without.rows());
  std::size_t proved = 0;
  for (std::size_t row = 0; row < with.rows(); ++row) {
    const Solution expected = with.solution(row, 0);
    const Solution found = without.solution(row, 0);
    REQUIRE(found.outcome == expected.outcome);
    CHECK(found.extent == expected.extent);
    if (found.outcome == Outcome::collapsed) {
      CHECK(found.displacement.array().isNaN().all());
      proved += found.iterations == 0 ? 1 : 0;
    } else {
      CHECK(without_nan(found.displacement) == without_nan(expected.displacement));
    }
  }
  CHECK(proved > 0);
}

}  // namespace

TEST_CASE("With outcomes only, the same scenes fall as in motion, and those that stand have the same bits") {
  const test::TemporaryFolder folder;
  const BridgeFile bridge = read_bridge_file(test::example_bridge("small"));
  const std::string scenes = "singles;0,*+4,1..3;0,*+0,*";
  const Built fields = build(folder, bridge, scenes, true);
  const Built outcomes = build(folder, bridge, scenes, false);
  check_same_outcomes(fields, outcomes);
  CHECK(fields.summary.digest != outcomes.summary.digest);
  CHECK_THAT(to_text(outcomes.summary), Catch::Contains("without fields"));
  CHECK_THAT(to_json(outcomes.summary), Catch::Contains("\"collapses\":\"outcome\""));
  CHECK_THAT(to_text(fields.summary), !Catch::Contains("without fields"));

  const VerifyReport report = verify_database({.database = outcomes.path, .recompute = 40});
  CHECK(report.ok());
  CHECK_FALSE(report.collapse_fields);
  CHECK_THAT(to_text(report, outcomes.path), Catch::Contains("without fields"));
  CHECK_THAT(to_json(report), Catch::Contains("\"collapses\":\"outcome\""));
  CHECK(verify_database({.database = fields.path}).collapse_fields);
}

TEST_CASE("With outcomes only, the same scenes of the reference bridge fall as in motion", "[whole-build]") {
  const test::TemporaryFolder folder;
  const std::string scenes = "singles;0,5+*,*;0,10+*,*;8,1+*,*;10,1+11,*";
  check_same_outcomes(build(folder, reference_bridge_file(), scenes, true),
                      build(folder, reference_bridge_file(), scenes, false));
}

}  // namespace voussoir
