#include "core/structure/mirror_symmetry.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/statics/equilibrium.h"
#include "core/statics/quasi_static_solver.h"
#include "tests/support/bridges.h"

using namespace voussoir;

TEST_CASE("Slip is mirrored so that forces are (image joints found by the nodes)", "[solver][symmetry]") {
  const Model bridge = test::small_bridge();
  REQUIRE(bridge.symmetry);
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  const Scene scene = parse_scene("4,2", bridge.layout);
  const auto joints = static_cast<Eigen::Index>(bridge.joints.size());
  // Pressed against each other by the weight, the joints stick with what is not slip.
  const Field field = without_nan(QuasiStaticSolver(bridge).solve(scene).displacement);
  const Eigen::Matrix2Xd slip = Eigen::Matrix2Xd::NullaryExpr(
      2, joints,
      [](Eigen::Index end, Eigen::Index joint) { return 1e-6 * std::sin(1.0 + 0.7 * joint + 2.0 * end); });
  const auto forces = [&](const Scene& of, const Field& at, const Eigen::Matrix2Xd& slipped) {
    return unbalanced_forces(StageEquations(system, coefficients, {.scene = of}, memory_of_slip(slipped)),
                             at);
  };
  const Field there = forces(scene, field, slip);
  const Field image = forces(mirrored(scene, *bridge.symmetry), mirrored(field, *bridge.symmetry),
                             mirrored_slip(slip, bridge.joints, *bridge.symmetry));
  CHECK(there.cwiseAbs().maxCoeff() > 1.0);
  CHECK((mirrored(there, *bridge.symmetry) - image).cwiseAbs().maxCoeff() <
        1e-7 * there.cwiseAbs().maxCoeff());
  CHECK(mirrored_slip({}, bridge.joints, *bridge.symmetry).size() == 0);
}
