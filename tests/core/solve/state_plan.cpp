#include "core/solve/state_plan.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "core/structure/mirror_symmetry.h"
#include "tests/support/bridges.h"

namespace voussoir {
namespace {

using Catch::Contains;

/// A lorry that passes in two steps and goes, and a force in the middle.
BridgeDescription loaded() {
  BridgeDescription description = test::small_description();
  description.loads = {{"lorry", {}, {}, {{0.0, 3e4}}, {2.0, 4.0}, std::nullopt, true},
                       {"crown", {{3.0, 1e4}}, {}, {}, {}, std::nullopt, false}};
  return description;
}

std::vector<std::string> names(const std::string& histories, const std::string& loads) {
  return state_names(histories, loads, loaded().loads);
}

StatePlan plan(const std::vector<std::string>& state_names) {
  return plan_states(state_names, test::small_bridge(), loaded());
}

}  // namespace

TEST_CASE("States are the histories, then the loads after each (written out)") {
  CHECK(names("built", "none") == std::vector<std::string>{"built"});
  CHECK(names("lost,built", "none") == std::vector<std::string>{"built", "lost"});
  CHECK(names("built,lost", "all") == std::vector<std::string>{"built", "lost", "built:lorry@1",
                                                               "built:lorry@2", "built:lorry@off",
                                                               "built:crown", "lost:lorry@1", "lost:lorry@2",
                                                               "lost:lorry@off", "lost:crown"});
  CHECK(names("lost", "crown") == std::vector<std::string>{"lost", "lost:crown"});
}

TEST_CASE("Histories and loads that there are not are refused with what was expected") {
  for (const char* histories : {"", "gone", "built,built", "built;lost", "built,"})
    CHECK_THROWS_WITH(names(histories, "none"), Contains("--history") && Contains("built,lost"));
  CHECK_THROWS_WITH(names("built", "bus"),
                    Contains("--loads") && Contains("'bus'") && Contains("lorry, crown"));
  CHECK_THROWS_WITH(names("built", "crown,crown"), Contains("--loads") && Contains("twice"));
  CHECK_THROWS_WITH(state_names("built", "bus", {}), Contains("it has none"));
}

TEST_CASE("Each state starts from the one before it; lost from built, kept or not (written out)") {
  const StatePlan both = plan(names("built,lost", "all"));
  const std::vector<std::optional<std::size_t>> before = {std::nullopt, 0, 0, 2, 3, 0, 1, 6, 7, 1};
  REQUIRE(both.size() == before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    INFO(both[i].name);
    CHECK(both[i].before == before[i]);
    CHECK(both[i].is_load == (i > 1));
    CHECK(both[i].kept);
  }
  const StatePlan lost = plan(names("lost", "crown"));
  REQUIRE(lost.size() == 3);
  CHECK(lost[0].name == "built");
  CHECK_FALSE(lost[0].kept);
  CHECK(lost[1].before == 0);
  CHECK(lost[2].before == 1);
  CHECK(kept_states(lost) == std::vector<std::size_t>{1, 2});
  CHECK(place_of_lost(lost) == 1);
  CHECK_FALSE(place_of_lost(plan({"built"})));
}

TEST_CASE("A state mirrors if its load and those before it are their own mirror images") {
  const StatePlan states = plan(names("built", "all"));
  CHECK(states[0].mirrors);
  for (std::size_t i = 1; i <= 3; ++i) CHECK_FALSE(states[i].mirrors);  // gone again, but what slipped stays
  CHECK(states[4].mirrors);
  const Field& crown = states[4].load;
  CHECK((mirrored(crown, *test::small_bridge().symmetry) - crown).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(has_one_sided_loads(states));
  CHECK_FALSE(has_one_sided_loads(plan(names("built", "crown"))));
}

TEST_CASE("Names that a database cannot have are refused") {
  CHECK_THROWS_WITH(plan({"built", "state 1"}), Contains("'state 1'"));
  CHECK_THROWS_WITH(plan({"built", "built:bus"}), Contains("no such load case"));
  CHECK_THROWS_WITH(plan({"built", "built:lorry"}), Contains("no such stage"));
  CHECK_THROWS_WITH(plan({"built", "built:lorry@2"}), Contains("expected the state 'built:lorry@1'"));
  CHECK_THROWS_WITH(plan({"built", "lost:crown"}), Contains("expected the state 'lost'"));
  CHECK_THROWS_WITH(plan({"lost", "built"}), Contains("out of place"));
  CHECK_THROWS_WITH(plan({"lost", "built:crown"}), Contains("expected the state 'built'"));
}

}  // namespace voussoir
