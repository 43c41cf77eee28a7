/// @file Databases of bridges that stand by what they have slid, in motion or in a jump.

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "database/records/database.h"
#include "generator/build.h"
#include "generator/records/outcome_counts.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

constexpr char kFewScenes[] = "intact;5,3;4,2;0,2;5,3+0,2";

/// Of test::sliding_description's bridge.
constexpr char kSlidingJoints[] =
    "\n[joints]\nnormal_stiffness_Pa_per_m = 3e7\ntangential_stiffness_Pa_per_m = 3e7\n"
    "friction_angle_deg = 25.783100780887047\n";

/// With these (4,2) jumps when it is lost.
constexpr char kJumpingJoints[] =
    "\n[joints]\nnormal_stiffness_Pa_per_m = 1e9\ntangential_stiffness_Pa_per_m = 1e9\n"
    "friction_angle_deg = 34.37746770784939\n";

/// A file of the small bridge with such joints, and a few scenes of it.
BuildRequest sliding_request(const test::TemporaryFolder& folder, const char* joints = kSlidingJoints) {
  std::ofstream(folder / "sliding.toml") << test::text_of(test::example_bridge("small")) << joints;
  BuildRequest request;
  request.bridge = read_bridge_file(folder / "sliding.toml");
  request.output = folder / "sliding.h5";
  request.scenes = kFewScenes;
  request.threads = 1;
  return request;
}

}  // namespace

TEST_CASE("Scenes that stand by what they have slid are stored with it and proved right (equilibrium)") {
  const test::TemporaryFolder folder;
  Progress quiet(Progress::Mode::quiet);
  BuildRequest request = sliding_request(folder);
  request.histories = "built,lost";
  build_database(request, quasi_static(), quiet);
  const Database database = Database::open(request.output);
  const Model bridge = make_model(request.bridge.description);
  const Scene slid = parse_scene("5,3", bridge.layout);
  const Solution found = database.solution(*database.find(kNominalVariant, slid), kBuilt);
  REQUIRE(stands(found));
  REQUIRE(found.slipped.cols() == static_cast<Eigen::Index>(bridge.joints.size()));
  CHECK(unbalanced_force(bridge, slid, found.displacement, found.slipped) < 1e-4);
  CHECK(unbalanced_force(bridge, slid, found.displacement) > 1e-2);
  CHECK(database.solution(*database.find(kNominalVariant, Scene{}), kBuilt).slipped.size() == 0);

  VerifyRequest check{request.output};
  check.threads = 1;
  check.recompute = 100;
  CHECK(verify_database(check).problems == std::vector<std::string>{});
}

TEST_CASE(
    "That an intact bridge stands by what it has slid is said, by the build and from the file (written "
    "out)") {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "slid.toml") << test::kSlidBridge;
  BuildRequest request;
  request.bridge = read_bridge_file(folder / "slid.toml");
  request.output = folder / "slid.h5";
  request.scenes = "intact;9,2";
  request.known_bridge = true;
  Progress quiet(Progress::Mode::quiet);
  const BuildSummary summary = build_database(request, quasi_static(), quiet);
  const Database database = Database::open(request.output);
  CHECK(database.stands_by_slip());
  for (const OutcomeCounts& counts : {summary.outcomes, count_outcomes(database)}) {
    CHECK_THAT(to_text(counts), Catch::Contains("intact bridge stands only by what its joints have slid"));
    CHECK(to_json(counts)["stands_by_slip"] == true);
    CHECK(to_json(counts)["intact"] == "standing");
  }
  // A file without fields does not know, and the build says no more than its file.
  request.fields = KeepField::no;
  request.output = folder / "light.h5";
  const OutcomeCounts built = build_database(request, quasi_static(), quiet).outcomes;
  CHECK(to_json(built)["intact"] == "standing");
  CHECK(to_json(built) == to_json(count_outcomes(Database::open(request.output))));
}

TEST_CASE("What has slid is taken over into another database, bit by bit (built anew)") {
  const test::TemporaryFolder folder;
  Progress quiet(Progress::Mode::quiet);
  BuildRequest request = sliding_request(folder);
  build_database(request, quasi_static(), quiet);
  request.scenes = std::string(kFewScenes) + ";4,1";
  const BuildSummary taken_over = build_database(request, quasi_static(), quiet);
  CHECK(taken_over.reused == 5);
  request.force = true;
  request.threads = 2;
  CHECK(build_database(request, quasi_static(), quiet).digest == taken_over.digest);
}

TEST_CASE("Losses that jump are stored with what they have slid and proved right (equilibrium)") {
  const test::TemporaryFolder folder;
  Progress quiet(Progress::Mode::quiet);
  BuildRequest request = sliding_request(folder, kJumpingJoints);
  request.histories = "built,lost";
  request.scenes = "intact;4,2;4,5;5,1;4,2+5,1";
  build_database(request, quasi_static(), quiet);
  const Database database = Database::open(request.output);
  const Model bridge = make_model(request.bridge.description);
  const std::size_t lost = 1;
  for (const char* name : {"4,2", "4,2+5,1"}) {
    const Solution found =
        database.solution(*database.find(kNominalVariant, parse_scene(name, bridge.layout)), lost);
    REQUIRE(stands(found));
    REQUIRE(has_slipped(found));
    CHECK(unbalanced_force(bridge, parse_scene(name, bridge.layout), found.displacement, found.slipped) <
          1e-4);
  }
  VerifyRequest check{request.output};
  check.threads = 1;
  check.recompute = 100;
  CHECK(verify_database(check).problems == std::vector<std::string>{});
}

}  // namespace voussoir
