/// @file Databases of several variants of a bridge.

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "core/error.h"
#include "database/records/database.h"
#include "database/records/variant_parameters.h"
#include "generator/build.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/made_up_solver.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

BridgeFile with_stiffness(BridgeFile file, double factor) {
  file.description.joints.normal_stiffness *= factor;
  file.text += fmt::format("# p_n times {}\n", factor);
  return file;
}

VariantParameters stiffer(double factor) {
  return variant_parameters(
      make_model(with_stiffness(test::small_bridge_file(), factor).description).parameters);
}

struct VariantsSite {
  test::TemporaryFolder folder;
  BuildRequest request;

  explicit VariantsSite(const std::vector<double>& other_variants) {
    request.bridge = test::small_bridge_file();
    request.output = folder / "small.h5";
    request.threads = 2;
    for (const double factor : other_variants) request.other_variants.push_back(stiffer(factor));
  }
  BuildSummary build(const SolverChoice& solver = test::made_up_solver()) const {
    Progress quiet(Progress::Mode::quiet);
    return build_database(request, solver, quiet);
  }
  Database open() const { return Database::open(request.output); }
};

/// Everything but the variant's number and the checksum, which covers it.
void check_same(Record record, const Record& alone) {
  REQUIRE(record.key.scene == alone.key.scene);
  REQUIRE(record.states.size() == alone.states.size());
  const RecordedState& state = record.states.at(0);
  const RecordedState& expected = alone.states.at(0);
  CHECK(state.outcome == expected.outcome);
  CHECK(state.residual == expected.residual);
  CHECK(state.iterations == expected.iterations);
  CHECK(state.moving == expected.moving);
  CHECK(std::ranges::equal(view_bytes(state.vertical), view_bytes(expected.vertical)));
  CHECK(state.packed_field == expected.packed_field);
}

}  // namespace

TEST_CASE("Two variants in one file are verified, and each is what is built of its bridge alone",
          "[many-solutions]") {
  VariantsSite both({1.2});
  both.request.scenes = "intact;4,1..3;0,5;4,1+4,2";
  CHECK(both.build(quasi_static()).outcomes.scenes == 12);
  const VerifyReport report = verify_database({both.request.output, 12});
  CHECK(report.problems == std::vector<std::string>{});
  CHECK(report.fields == 12);
  CHECK(report.recomputed == 12);
  CHECK(report.largest_recomputed_difference == 0.0);
  const Database database = both.open();
  REQUIRE(database.variants().size() == 2);
  CHECK(database.variants()[1] == stiffer(1.2));
  CHECK(database.table(1, 0).vertical[0] != database.table(0, 0).vertical[0]);
  for (const std::int32_t variant : {0, 1}) {
    VariantsSite alone({});
    alone.request.scenes = both.request.scenes;
    if (variant == 1) alone.request.bridge = with_stiffness(alone.request.bridge, 1.2);
    alone.build(quasi_static());
    const Database expected = alone.open();
    const SceneTable table = database.table(variant, 0);
    REQUIRE(table.rows == expected.table().rows);
    for (std::size_t row = 0; row < table.rows; ++row)
      check_same(database.record(table.first_record + row), expected.record(row));
  }
}

TEST_CASE("A build of variants that is interrupted goes on and ends with the same digest", "[threads]") {
  const std::string expected = VariantsSite({1.2, 0.5}).build().digest;
  for (const int scenes : {1, 3, 50, 400, 1000}) {
    const VariantsSite site({1.2, 0.5});
    REQUIRE_THROWS_AS(site.build(test::failing_solver(scenes)), Failure);
    const BuildSummary summary = site.build();
    CHECK(summary.resumed + summary.computed == summary.outcomes.scenes);
    CHECK(summary.digest == expected);
  }
}

TEST_CASE("The records of an interrupted build with other variants are not mixed in") {
  VariantsSite site({1.2});
  REQUIRE_THROWS_AS(site.build(test::failing_solver(500)), Failure);
  site.request.other_variants = {stiffer(1.3)};
  CHECK(site.build().resumed == 0);
  CHECK(site.open().digest() == VariantsSite({1.3}).build().digest);
}

TEST_CASE("Variants that the old file has are taken over, whatever their number was") {
  VariantsSite site({1.2, 0.5});
  const std::size_t scenes = site.build().outcomes.scenes / 3;
  CHECK(site.build(test::failing_solver(1)).up_to_date);
  site.request.other_variants = {stiffer(0.5), stiffer(2.0), stiffer(1.2)};
  const BuildSummary summary = site.build();
  REQUIRE(summary.changes.size() == 2);
  CHECK(summary.changes[0] == "other variants of the bridge are wanted (4, was 3)");
  CHECK(summary.reused == 3 * scenes);
  CHECK(summary.computed == scenes);
  CHECK(summary.digest == VariantsSite({0.5, 2.0, 1.2}).build().digest);
}

TEST_CASE("Of as many variants it is said which of their values are others (one made stiffer)") {
  VariantsSite site({1.2});
  site.build();
  site.request.other_variants = {stiffer(0.5)};
  CHECK_THROWS_WITH(site.build(), Catch::Contains("742 of its 1484 scenes would be lost"));
  site.request.drop = true;
  const std::vector<std::string> changes = site.build().changes;
  REQUIRE(!changes.empty());
  CHECK_THAT(changes[0], Catch::Contains("other values of blocks or joints are wanted (") &&
                             Catch::Contains("stiffness") && !Catch::Contains("density"));
}

TEST_CASE("Variants may have fewer scenes than the nominal bridge; each is what it is alone",
          "[many-solutions]") {
  VariantsSite site({1.2, 0.5});
  site.request.scenes = "singles;4,1+4,2";
  site.request.scenes_of_variants = "intact;4,2..3";
  CHECK(site.build(quasi_static()).outcomes.scenes == 40 + 2 * 3);
  const Database database = site.open();
  CHECK(database.table(0, 0).rows == 40);
  for (const std::int32_t variant : {1, 2}) REQUIRE(database.table(variant, 0).rows == 3);
  VariantsSite alone({});
  alone.request.scenes = site.request.scenes_of_variants;
  alone.request.bridge = with_stiffness(alone.request.bridge, 0.5);
  alone.build(quasi_static());
  const Database expected = alone.open();
  for (std::size_t row = 0; row < 3; ++row)
    check_same(database.record(database.table(2, 0).first_record + row), expected.record(row));
  CHECK(site.build(quasi_static()).up_to_date);
  CHECK(verify_database({site.request.output, 5}).problems == std::vector<std::string>{});
}

TEST_CASE("The digest of variants is the same for 1, 2 and 5 threads") {
  std::set<std::string> digests;
  for (const int threads : {1, 2, 5}) {
    VariantsSite site({1.2, 0.5, 0.7});
    site.request.scenes_of_variants = "singles";
    site.request.histories = "built,lost";
    site.request.threads = threads;
    digests.insert(site.build().digest);
  }
  CHECK(digests.size() == 1);
}

TEST_CASE("A scene of a variant whose field is not that variant's is found by solving it anew") {
  VariantsSite site({1.2});
  site.request.scenes = "intact;4,1..3";
  site.build(quasi_static());
  const Database right = site.open();
  // The same file, but it says that the second variant's joints are softer than they were.
  const Model bridge = make_model(site.request.bridge.description);
  std::vector<RecordKey> keys;
  for (std::size_t row = 0; row < right.rows(); ++row) keys.push_back(right.key(row));
  const auto wrong = site.folder / "wrong.h5";
  write_database(
      wrong,
      {right.provenance(), bridge, {right.variants()[0], stiffer(0.9)}, keys, right.states(), KeepField::yes},
      [&](std::size_t row) { return right.record(row); });
  const VerifyReport report = verify_database({wrong, keys.size()});
  CHECK(report.recomputed == keys.size());
  REQUIRE(report.problems.size() >= 4);
  for (const std::string& problem : report.problems) CHECK_THAT(problem, Catch::Contains("of variant 1: "));
}

}  // namespace voussoir
