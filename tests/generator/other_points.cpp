/// @file Databases of bridges at which other points are measured than before. Oracle: the same database built
/// from nothing.

#include <catch2/catch.hpp>

#include "database/records/database.h"
#include "generator/build.h"
#include "generator/scenes/results_key.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/made_up_solver.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

constexpr const char* kSensor = "[[sensors]]\nname = \"N1\"\nquantity = \"tilt\"\nblock = \"4,2\"\n";

/// A folder to build in, and what is asked for of the small bridge.
struct PointsSite {
  test::TemporaryFolder folder;
  BuildRequest request;

  explicit PointsSite(const std::string& scenes, const std::string& more = "") {
    measure(more);
    request.output = folder / "small.h5";
    request.scenes = scenes;
    request.histories = "built,lost";
    request.threads = 2;
    request.known_bridge = true;  // records are looked at here
  }
  void measure(const std::string& more) {
    request.bridge = parse_bridge_file(test::small_bridge_file().text + more, "small.toml");
  }
  BuildSummary build(const SolverChoice& solver = quasi_static()) const {
    Progress quiet(Progress::Mode::quiet);
    return build_database(request, solver, quiet);
  }
};

}  // namespace

TEST_CASE("Where sensors are added every solved scene is kept, and the file is that of a new build") {
  const std::string scenes = "intact;singles;4,1+4,2;4,1+5,3;5,1+5,4";
  PointsSite site(scenes);
  const std::size_t count = site.build().computed;
  site.measure(kSensor);
  const BuildSummary again = site.build();
  CHECK(again.reused == count);
  CHECK(again.computed == 0);
  CHECK(again.digest == PointsSite(scenes, kSensor).build().digest);
  const Database database = Database::open(site.request.output);
  CHECK(verify_database({site.request.output, database.rows()}).problems == std::vector<std::string>{});
  site.measure("");  // and where they are taken away
  const BuildSummary before = site.build();
  CHECK(before.computed == 0);
  CHECK(before.digest == PointsSite(scenes).build().digest);
}

TEST_CASE("Control points that are switched off leave every solved scene, too") {
  const std::string without = "[control_points]\narch = false\n";
  PointsSite site("singles");
  const std::size_t count = site.build().computed;
  site.measure(without);
  const BuildSummary again = site.build();
  CHECK(again.reused == count);
  CHECK(again.digest == PointsSite("singles", without).build().digest);
}

TEST_CASE("Three missing blocks are solved anew where other points are measured") {
  const std::string scenes = "4,1;4,2;5,3;4,1+4,2;4,1+5,3;4,2+5,3;intact;4,1+4,2+5,3";
  PointsSite site(scenes);
  site.build();
  site.measure(kSensor);
  const BuildSummary again = site.build();
  CHECK(again.reused == 7);
  CHECK(again.computed == 1);
  CHECK(again.digest == PointsSite(scenes, kSensor).build().digest);
}

TEST_CASE("Without fields nothing can be read at other points") {
  PointsSite site("singles");
  site.request.fields = KeepField::no;
  site.build(test::made_up_solver());
  site.measure(kSensor);
  CHECK(site.build(test::made_up_solver()).reused == 0);
}

TEST_CASE("Other points change the key of what is read, not that of fields") {
  const PointsSite site("singles"), other("singles", kSensor);
  const BridgeDescription &before = site.request.bridge.description, &now = other.request.bridge.description;
  CHECK(results_key(before, {}) == results_key(now, {}));
  CHECK(points_key(before) != points_key(now));
}

}  // namespace voussoir
