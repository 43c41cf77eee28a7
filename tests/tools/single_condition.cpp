/// @file What an intact bridge does if one condition alone is at more than its stated deviation, and all
/// others at none. Oracle: nothing is missing; bridges with their own joints, solved nonlinearly.

#include <catch2/catch.hpp>

#include "generator/build.h"
#include "tests/support/bridges.h"
#include "tests/support/temporary_folder.h"
#include "tools/trials/sampled_truth.h"
#include "tools/trials/trial_series.h"

using namespace voussoir;

namespace {

/// The small bridge with all its scenes, as uncertain as bridges without an [uncertainty] of their own.
struct SmallBridge {
  test::TemporaryFolder folder;
  BridgeFile file = read_bridge_file(test::example_bridge("small"));
  Database database = build();
  SensorList sensors = control_point_sensors(database.control_points());

  Database build() const {
    BuildRequest request;
    request.bridge = file;
    request.output = folder / "small.h5";
    request.histories = "built,lost";
    request.fields = KeepField::no;
    Progress quiet(Progress::Mode::quiet);
    build_database(request, quasi_static(), quiet);
    return Database::open(request.output);
  }
};

}  // namespace

TEST_CASE("A foot that alone is lower than stated, or warmth alone, is no damage (solved nonlinearly)") {
  const SmallBridge site;
  const Asking asking{site.database, site.sensors, {}, false};
  const SampledTruth joints{"joints", scattered_joints(0.2), 4, 4711};
  for (const Between& between :
       {Between{.settlement = 1.1e-3}, Between{.settlement = 1.3e-3}, Between{.settlement = 1.5e-3},
        Between{.warmer = 17.0}, Between{.warmer = 20.0}, Between{.warmer = 23.0}}) {
    const IntactTruth truth = solve_intact(site.file.description, joints, between);
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      for (const Trial& trial : look_at_intact(asking, truth.bridges, {ReadingsTaken::change, 1e-5, seed})) {
        INFO(between.settlement << " m, " << between.warmer << " K");
        CHECK_FALSE(is_alarm(trial.verdict));
        CHECK(trial.verdict != Verdict::unexplained);
      }
  }
}
