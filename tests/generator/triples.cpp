/// @file Three missing blocks: all triples of a part of the small bridge against their own full solution.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "database/records/database.h"
#include "generator/build.h"
#include "generator/merge.h"
#include "generator/scenes/composition.h"
#include "generator/scenes/scene_list.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

/// Wall and arch blocks among which triples stand, are composed, inherit and fall on their own.
constexpr const char* kScenes = "intact;1,*+2,*+3..5,2;0,4+1,*+2,*";

struct Bridge {
  test::TemporaryFolder folder;
  BridgeFile file = read_bridge_file(test::example_bridge("small"));

  BuildRequest request(const std::string& name, const PlanRules& rules = {}) const {
    BuildRequest request;
    request.bridge = file;
    request.output = folder / name;
    request.scenes = kScenes;
    request.histories = "built,lost";
    request.rules = rules;
    request.known_bridge = true;
    return request;
  }

  Database build(const BuildRequest& request) const {
    Progress quiet(Progress::Mode::quiet);
    build_database(request, quasi_static(), quiet);
    return Database::open(request.output);
  }
};

std::size_t count(const Database& database, std::size_t state, Origin origin) {
  const SceneTable table = database.table(kNominalVariant, state);
  std::size_t found = 0;
  for (std::size_t row = 0; row < table.rows; ++row) found += table.origin_of(row) == origin ? 1 : 0;
  return found;
}

}  // namespace

TEST_CASE(
    "Triples that inherit fall in motion, too, and composed ones are as their equilibrium is "
    "(every scene solved in full)",
    "[many-solutions]") {
  const Bridge bridge;
  const Database quick = bridge.build(bridge.request("quick.h5"));
  const Database full = bridge.build(bridge.request("full.h5", {.inherited = false, .composed = false}));
  REQUIRE(quick.rows() == full.rows());
  REQUIRE(count(full, 0, Origin::solved) == full.rows());
  CHECK(count(quick, 0, Origin::composed) > 0);
  for (const std::size_t state : {0U, 1U}) {
    CHECK(count(quick, state, Origin::inherited) > 10);
    const SceneTable found = quick.table(kNominalVariant, state);
    const SceneTable expected = full.table(kNominalVariant, state);
    for (std::size_t row = 0; row < found.rows; ++row) {
      INFO(to_string(found.scene(row), quick.layout()));
      REQUIRE(found.outcome[row] == expected.outcome[row]);
      const std::vector<double> numbers(found.row(row).begin(), found.row(row).end());
      if (found.origin_of(row) == Origin::inherited)
        CHECK(std::ranges::all_of(numbers, [](double number) { return std::isnan(number); }));
      if (found.origin_of(row) == Origin::composed)
        CHECK(composed_error(found.row(row), expected.row(row), expected.row(0)) <= 1.0);
    }
  }
}

TEST_CASE("What triples inherit and compose is verified by solving them in full", "[many-solutions]") {
  const Bridge bridge;
  const Database quick = bridge.build(bridge.request("quick.h5"));
  const VerifyReport report = verify_database({.database = quick.path(), .recompute = 60});
  CHECK(report.problems == std::vector<std::string>{});
  CHECK(report.recomputed_inherited > 0);
  CHECK_THAT(to_text(report, quick.path()), Catch::Contains("inherited"));
}

TEST_CASE("Triples that few sensors see, on one side, are composed only where all is right (solved in full)",
          "[many-solutions]") {
  Bridge bridge;
  bridge.file = parse_bridge_file(bridge.file.text +
                                      "[control_points]\ntop = false\narch = false\n"
                                      "[[sensors]]\nname = \"S\"\nx_m = 0.9\ny_m = 2.3\nblock = \"5,2\"\n",
                                  "sensor");
  BuildRequest request = bridge.request("sensor.h5");
  request.histories = "built";
  request.scenes = std::string(kScenes) + ";5,6+4,*+5,*;5,6+5,*+5,*;5,6+3,*+4,*;5,6+4,*+4,*";
  const Database database = bridge.build(request);
  CHECK(count(database, 0, Origin::composed) > 0);
  const VerifyReport report = verify_database({.database = database.path(), .recompute = 300});
  CHECK(report.problems == std::vector<std::string>{});
}

TEST_CASE("Parts of a database of triples give the digest of one build, with fields and without",
          "[many-solutions]") {
  const Bridge bridge;
  for (const KeepField fields : {KeepField::yes, KeepField::no}) {
    BuildRequest whole = bridge.request(fields == KeepField::yes ? "fields.h5" : "points.h5");
    whole.fields = fields;
    whole.histories = "built";
    const Database single = bridge.build(whole);
    MergeRequest merge;
    merge.output = bridge.folder / "merged.h5";
    merge.force = true;
    for (const int number : {2, 3, 1}) {
      BuildRequest part = whole;
      part.shard = Shard{number, 3};
      part.output = bridge.folder / fmt::format("part{}-{}.h5", number, fields == KeepField::yes);
      bridge.build(part);
      merge.parts.push_back(part.output);
    }
    Progress quiet(Progress::Mode::quiet);
    const auto solver = [](const std::string&) { return quasi_static(); };
    CHECK(merge_databases(merge, solver, quiet).digest == single.digest());
  }
}

TEST_CASE("A database of pairs is as it was before there were triples: no column of origins") {
  const Bridge bridge;
  BuildRequest request = bridge.request("pairs.h5");
  request.scenes = "singles;0,*+0,*";
  request.histories = "built";
  const Database pairs = bridge.build(request);
  CHECK_THROWS(pairs.dataset_bytes("scenes/origin"));
  CHECK(count(pairs, 0, Origin::solved) == pairs.rows());
}

TEST_CASE("The list triples has the count of combinatorics and all that its scenes are made of") {
  const BlockLayout layout = lay_blocks(read_bridge_file(test::example_bridge("small")).description);
  CHECK(parse_scene_list("triples", layout) == all_scenes(38, 3));
  CHECK(parse_scene_list("triples", layout).size() == 1 + 38 + 703 + 8436);
  CHECK(parse_scene_list("2,1+0,2+0,1", layout).front().missing() == 3);
  const auto arch = static_cast<std::size_t>(layout.last_position(0));
  CHECK(parse_scene_list("0,*+0,*+0,*", layout).size() == arch * (arch - 1) * (arch - 2) / 6);
}

}  // namespace voussoir
