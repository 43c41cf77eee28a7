/// @file Databases of bridges that stand by what they have slid in motion.

#include <catch2/catch.hpp>
#include <fstream>

#include "database/records/database.h"
#include "generator/build.h"
#include "generator/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

constexpr char kFewScenes[] = "intact;5,3;4,2;0,2;5,3+0,2";

/// A file of test::sliding_description's bridge, and a few scenes of it.
BuildRequest sliding_request(const test::TemporaryFolder& folder) {
  const std::string text = test::text_of(test::example_bridge("small")) +
                           "\n[joints]\nnormal_stiffness_Pa_per_m = 3e7\n"
                           "tangential_stiffness_Pa_per_m = 3e7\nfriction_angle_deg = 25.783100780887047\n";
  std::ofstream(folder / "sliding.toml") << text;
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

}  // namespace voussoir
