#include "generator/uncertainty/model_error.h"

#include <catch2/catch.hpp>

#include "tests/support/bridges.h"

namespace voussoir {

TEST_CASE("What a sudden release adds to the mesh's error adds in squares (3, 4 and 5)") {
  const ModelError both =
      with_sudden_release({0.75 * kShareOfSuddenRelease, 4.0 / 3.0 * kCommonOfSuddenRelease, {}});
  CHECK(both.share == Approx(1.25 * kShareOfSuddenRelease));
  CHECK(both.common == Approx(5.0 / 3.0 * kCommonOfSuddenRelease));
}

TEST_CASE("States after a loss have the mesh's error and that of a sudden release, others the mesh's alone") {
  BridgeDescription description = test::small_description();
  description.loads = {{"crown", {{3.0, 1e3}}, {}, {}, {}, std::nullopt, false}};
  const Model bridge = make_model(description);
  const SolverChoice solver = quasi_static();
  const std::vector<std::string> names = {"built", "lost", "built:crown", "lost:crown"};
  const StatePlan states = plan_states(names, bridge, description);
  Progress quiet(Progress::Mode::quiet);
  const std::vector<ModelError> errors = estimate_model_errors({description, bridge, states, solver}, quiet);
  REQUIRE(errors.size() == names.size());
  for (const std::size_t state : {0U, 2U}) {
    CHECK(errors[state].share + errors[state].common > 0.0);
    CHECK(errors[state].share < kShareOfSuddenRelease);
    CHECK(errors[state].common < kCommonOfSuddenRelease);
  }
  for (const std::size_t state : {1U, 3U}) {
    CHECK(errors[state].share >= kShareOfSuddenRelease);
    CHECK(errors[state].common >= kCommonOfSuddenRelease);
    // Without the release nothing but the mesh is left, which is off by far less than half of a signal.
    CHECK(errors[state].share < 0.5);
    CHECK(errors[state].common < 0.5);
  }
}

TEST_CASE("A bridge whose mesh is too fine to be refined keeps the error of a sudden release (written out)") {
  BridgeDescription description = test::small_description();
  description.mesh.refinement = 4;
  const Model bridge = make_model(description);
  const StatePlan states = plan_states({"built", "lost"}, bridge, description);
  Progress quiet(Progress::Mode::quiet);
  const std::vector<ModelError> errors =
      estimate_model_errors({description, bridge, states, quasi_static()}, quiet);
  CHECK(errors == std::vector<ModelError>{{}, {kShareOfSuddenRelease, kCommonOfSuddenRelease, {}}});
}

}  // namespace voussoir
