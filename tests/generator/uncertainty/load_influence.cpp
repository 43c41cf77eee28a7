/// @file What a load adds to the intact bridge's readings. Oracle: the bridge solved anew under a little more
/// and a little less of it.

#include "generator/uncertainty/load_influence.h"

#include <catch2/catch.hpp>

#include "core/structure/top_surface.h"
#include "generator/build.h"
#include "tests/support/bridges.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

constexpr double kWidth = 3.0;  // [m]

Eigen::VectorXd readings_under(QuasiStaticSolver& solver, const Model& bridge, double x, double force) {
  Field load = Field::Zero(2, bridge.mesh.node_count());
  TopSurface(bridge.mesh).add_force(x, force, load);
  const Solution solution = solver.solve(StageTask{.stage = {.load = load}});
  REQUIRE(stands(solution));
  return readings_at(bridge.control_points, solution.displacement);
}

}  // namespace

TEST_CASE("The influence of a load is what a little of it adds to the intact bridge (solved anew)",
          "[sensitivity]") {
  const test::TemporaryFolder folder;
  BuildRequest request;
  request.bridge = test::small_bridge_file();
  request.bridge.description.material.thickness = kWidth;
  Region deeper{{"1,1"}, request.bridge.description.material, request.bridge.description.joints};
  deeper.material.thickness = 2.0 * kWidth;  // one stone does not make the bridge wider
  request.bridge.description.regions = {deeper};
  request.output = folder / "small.h5";
  request.scenes = "intact;4,1";
  Progress quiet(Progress::Mode::quiet);
  build_database(request, quasi_static(), quiet);
  const Database database = Database::open(request.output);
  REQUIRE(database.sensitivities() != nullptr);
  const LoadInfluence& found = database.sensitivities()->load;
  const Model bridge = make_model(request.bridge.description);
  REQUIRE(found.places.size() == 13);  // 6 m, every half metre
  CHECK(found.places.front() == Approx(0.0));
  CHECK(found.places.back() == Approx(6.0));
  QuasiStaticSettings exact;
  exact.tolerance = 1e-11;
  QuasiStaticSolver solver(bridge, exact);
  constexpr double kStep = 1.0;  // [N] for each metre of the width
  for (std::size_t i = 0; i < found.places.size(); ++i) {
    INFO("at x = " << found.places[i]);
    const Eigen::VectorXd anew = (readings_under(solver, bridge, found.places[i], kWidth * kStep) -
                                  readings_under(solver, bridge, found.places[i], -kWidth * kStep)) /
                                 (2.0 * kStep);
    const auto column = static_cast<Eigen::Index>(i);
    CHECK((found.readings.col(column) - anew).norm() < 1e-5 * anew.norm());
  }
}

}  // namespace voussoir
