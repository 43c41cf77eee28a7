#include "generator/scenes/state_solving.h"

#include <catch2/catch.hpp>

#include "core/structure/loads.h"
#include "database/format/field_codec.h"
#include "tests/support/bridges.h"
#include "tools/validation/history.h"

namespace voussoir {
namespace {

// Two searches for one equilibrium end within the solver's tolerance of each other (see kSameDisplacement);
// what joints remember of a rounded field is off by a storage step.
constexpr double kSameSearch = 1e-9;

struct Subject {
  BridgeDescription description = test::small_description();
  Model bridge = make_model(description);
  StageSolver solver;

  Subject() {
    description.loads = {{"lorry", {}, {}, {{0.0, 1e4}}, {2.0, 4.0}, std::nullopt, true}};
    const SolverChoice choice = quasi_static();
    solver = choice.make_solver(bridge, choice.settings(bridge));
  }
  Scene scene(const char* text) const { return parse_scene(text, bridge.layout); }
  StatePlan plan(const char* histories, const char* loads) const {
    return plan_states(state_names(histories, loads, description.loads), bridge, description);
  }
  SceneStates states_of(const Scene& scene, const StatePlan& plan, const StartingFields& starts) const {
    SceneGroup group{.solved = scene, .states = {}, .image = {}};
    const StateSolving solving(bridge, plan);
    solving.solve(solver, solving.basis(solver, starts, PlanRules{}), std::span(&group, 1));
    return group.states;
  }
  StartingFields intact(const StatePlan& plan) const {
    StartingFields starts;
    const SceneStates states = states_of(Scene{}, plan, starts);
    for (std::size_t state = 0; state < states.size(); ++state) starts.add(Scene{}, state, *states[state]);
    return starts;
  }
};

double apart(const Field& first, const Field& second) {
  return (without_nan(first) - without_nan(second)).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE(
    "The states of a scene are those that its history gives (solved as one history, independent starts)") {
  const Subject subject;
  const StatePlan plan = subject.plan("built,lost", "all");
  const StartingFields starts = subject.intact(plan);
  const Scene scene = subject.scene("4,2");
  const SceneStates states = subject.states_of(scene, plan, starts);
  QuasiStaticSolver solver(subject.bridge);
  for (const bool is_lost : {false, true}) {
    validation::History history = is_lost ? validation::lost(scene) : validation::built(scene);
    for (const LoadStage& stage : load_stages(subject.description.loads[0], subject.bridge, 1.0)) {
      Stage next = history.stages.back().stage;
      next.load = stage.force;
      history.stages.push_back({stage.name, next});
    }
    const std::vector<Solution> expected = validation::solve_history(solver, history);
    const std::size_t first = expected.size() - 4;  // without gravity on the intact bridge
    std::vector<std::size_t> places = {is_lost ? 1U : 0U};
    for (std::size_t i = 0; i < 3; ++i) places.push_back((is_lost ? 5U : 2U) + i);
    for (std::size_t i = 0; i < places.size(); ++i) {
      INFO(plan[places[i]].name);
      REQUIRE(expected[first + i].outcome == Outcome::standing);
      REQUIRE(states[places[i]]->outcome == Outcome::standing);
      CHECK(apart(states[places[i]]->displacement, expected[first + i].displacement) < kSameSearch);
    }
  }
  CHECK(apart(states[0]->displacement, states[1]->displacement) > 1e3 * kSameSearch);
}

TEST_CASE(
    "Lost of the intact bridge is built, and a load on a scene that falls changes nothing, bit by bit") {
  const Subject subject;
  const StatePlan plan = subject.plan("built,lost", "all");
  const StartingFields starts = subject.intact(plan);
  const SceneStates intact = subject.states_of(Scene{}, plan, StartingFields{});
  CHECK(intact[0]->displacement == intact[1]->displacement);
  CHECK(intact[0]->iterations == intact[1]->iterations);
  const SceneStates fallen = subject.states_of(subject.scene("0,5"), plan, starts);
  REQUIRE(fallen[0]->outcome == Outcome::collapsed);
  for (std::size_t state = 1; state < plan.size(); ++state) {
    CHECK(fallen[state]->outcome == Outcome::collapsed);
    CHECK(fallen[state]->moving == fallen[0]->moving);
    CHECK(apart(fallen[state]->displacement, fallen[0]->displacement) == 0.0);
  }
}

TEST_CASE(
    "States that are known already are taken as they are, and the others come out the same, bit by bit") {
  const Subject subject;
  const StatePlan plan = subject.plan("built,lost", "all");
  const StartingFields starts = subject.intact(plan);
  const Scene scene = subject.scene("4,2");
  const SceneStates all = subject.states_of(scene, plan, starts);
  const StateSolving solving(subject.bridge, plan);
  const SearchBasis basis = solving.basis(subject.solver, starts, PlanRules{});
  for (const std::vector<std::size_t>& unknown : {std::vector<std::size_t>{1, 3, 6}, {5, 6, 7}, {7}}) {
    SceneGroup group{.solved = scene, .states = all, .image = {}};
    for (std::optional<Solution>& state : group.states) state->memory.clear();  // as in a database
    for (const std::size_t state : unknown) group.states[state].reset();
    solving.solve(subject.solver, basis, std::span(&group, 1));
    for (std::size_t state = 0; state < plan.size(); ++state)
      CHECK(apart(group.states[state]->displacement, all[state]->displacement) == 0.0);
  }
}

TEST_CASE("A load that a bridge cannot carry without a block makes it collapse, and the blocks are named") {
  Subject subject;
  subject.description.loads = {{"wheel", {{1.0, 8e3}}, {}, {}, {}, std::nullopt, false}};
  const StatePlan plan = subject.plan("built", "all");
  const SceneStates states = subject.states_of(subject.scene("2,1"), plan, subject.intact(plan));
  REQUIRE(states[0]->outcome == Outcome::standing);
  CHECK(states[1]->outcome == Outcome::collapsed);
  CHECK_FALSE(states[1]->moving.empty());
}

TEST_CASE("A load on a removed block does not act, and one that crushes the bridge makes it collapse") {
  Subject subject;
  subject.description.loads = {{"heavy", {{0.2, 1e9}}, {}, {}, {}, std::nullopt, false}};
  const StatePlan plan = subject.plan("built", "all");
  const StartingFields starts = subject.intact(plan);
  const SceneStates without = subject.states_of(subject.scene("5,1"), plan, starts);
  REQUIRE(without[1]->outcome == Outcome::standing);
  CHECK(apart(without[1]->displacement, without[0]->displacement) < kSameSearch);
  // Joints of 1e9 Pa/m give way by more than thirty sags.
  CHECK(subject.states_of(subject.scene("4,1"), plan, starts)[1]->outcome == Outcome::collapsed);
}

}  // namespace voussoir
