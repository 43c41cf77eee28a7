#include "generator/scenes/steps_of_loss.h"

#include <catch2/catch.hpp>

#include "core/solve/state_plan.h"
#include "generator/build.h"
#include "generator/scenes/state_solving.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/temporary_folder.h"
#include "tools/validation/history.h"

namespace voussoir {
namespace {

/// The reference bridge, whose sliver (10,11) slides on the way when (10,12) goes.
struct Reference {
  BridgeFile file = reference_bridge_file();
  Model bridge = make_model(file.description);
  StatePlan plan = plan_states({"built", "lost"}, bridge, file.description);
  StateSolving solving{bridge, plan};
  StageSolver solver;
  QuasiStaticSolver newton{bridge};
  StartingFields starts;

  Reference() {
    const SolverChoice choice = quasi_static();
    solver = choice.make_solver(bridge, choice.settings(bridge));
    for (const char* text : {"intact", "10,12", "4,10", "2,6"}) add(scene(text));
  }
  Scene scene(const std::string& text) const {
    return text == "intact" ? Scene{} : parse_scene(text, bridge.layout);
  }
  SceneStates solve(const Scene& scene) const {
    SceneGroup group{.solved = scene, .states = {}, .image = {}};
    solving.solve(solver, solving.basis(solver, starts, PlanRules{}), std::span(&group, 1));
    return group.states;
  }
  void add(const Scene& scene) {
    const SceneStates states = solve(scene);
    for (std::size_t state = 0; state < states.size(); ++state) starts.add(scene, state, *states[state]);
  }
  /// Signal of a history in so many steps, from its own start.
  Eigen::VectorXd expected(const std::string& name, int steps) {
    validation::History history = validation::lost(scene(name));
    history.stages.back().steps = steps;
    return signal(validation::solve_history(newton, history).back().displacement);
  }
  Eigen::VectorXd signal(const Field& field) const {
    const Eigen::VectorXd change =
        readings_at(bridge.control_points, field) - readings_at(bridge.control_points, *starts.intact(0));
    return change.array().isNaN().select(0.0, change);
  }
};

double difference(const Eigen::VectorXd& signal, const Eigen::VectorXd& expected) {
  return (signal - expected).lpNorm<1>() / expected.lpNorm<1>();
}

/// The reference bridge's database of some scenes as lost, without an estimate of the mesh's error.
BuildRequest request_of(const test::TemporaryFolder& folder, const std::string& scenes) {
  BuildRequest request;
  request.bridge = reference_bridge_file();
  request.output = folder / "some.h5";
  request.scenes = scenes;
  request.histories = "built,lost";
  return request;
}

BuildSummary build(const BuildRequest& request) {
  SolverChoice solver = quasi_static();
  solver.make_equilibrium_solver = nullptr;
  Progress quiet(Progress::Mode::quiet);
  return build_database(request, solver, quiet);
}

}  // namespace

TEST_CASE("Singles go in many steps, and others if they have a block that needs many (written out)") {
  StepsOfLoss steps;
  const BlockId one{3}, other{5}, third{7};
  CHECK(steps.of({{one}}) == kStepsOfLoss);
  CHECK(steps.of({{one, other}}) == 1);
  steps.add(other);
  CHECK(steps.of({{other}}) == kStepsOfLoss);
  CHECK(steps.of({{one, other}}) == kStepsOfSeveral);
  CHECK(steps.of({{one, third}}) == 1);
  CHECK(steps.of({{one, other, third}}) == kStepsOfSeveral);
}

TEST_CASE(
    "Signals differ by their L1 difference over the better signal, points that are gone aside (by hand)") {
  const double gone = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ControlPoint> points = {
      {"T1", NodeId{0}, {}, {}}, {"T2", NodeId{1}, {}, {}}, {"T3", NodeId{2}, {}, {}}};
  Field intact = Field::Zero(2, 3), many = Field::Zero(2, 3);
  intact.row(1) << 1.0, 1.0, 1.0;
  many.row(1) << 1.5, 0.5, gone;  // a signal of 1 in sum
  for (const double off : {-0.0101, -0.0099, 0.0099, 0.0101}) {
    Field one = many;
    one(1, 0) += 0.5 * off;
    one(1, 1) -= 0.5 * off;
    CHECK(differ_in_signal(one, many, intact, points) == (std::abs(off) > kSameSignal));
  }
}

TEST_CASE(
    "The generator loses (10,12), alone and in a pair, in many steps, and a pair without it in one "
    "(histories of their own)") {
  // Two searches for one equilibrium differ by less than a nanometre (kSameDisplacement) at each point; the
  // signals are 1e-3 m and more in sum, over 78 points.
  constexpr double kSameSearch = 1e-4;
  Reference subject;
  const auto found = [&](const char* name) {
    const SceneStates states = subject.solve(subject.scene(name));
    REQUIRE(states[1]->outcome == Outcome::standing);
    return subject.signal(states[1]->displacement);
  };
  const Eigen::VectorXd alone = found("10,12"), with = found("4,10+10,12"), without = found("2,6+4,10");
  CHECK(difference(alone, subject.expected("10,12", kStepsOfLoss)) < kSameSearch);
  CHECK(difference(alone, subject.expected("10,12", 1)) > kSameSignal);
  CHECK(difference(with, subject.expected("4,10+10,12", kStepsOfSeveral)) < kSameSearch);
  CHECK(difference(without, subject.expected("2,6+4,10", 1)) < kSameSearch);
}

TEST_CASE(
    "Scenes of many steps come out the same from a build that goes on with another's singles, and "
    "solved anew, bit by bit",
    "[many-solutions]") {
  const test::TemporaryFolder folder, other;
  const std::string scenes = "intact;10,12;10,14;4,10;4,10+10,12;10,12..14;10,12+10,14";
  const std::string expected = build(request_of(folder, scenes)).digest;
  const BuildSummary singles = build(request_of(other, "intact;10,12;10,14"));
  const BuildSummary all = build(request_of(other, scenes));
  CHECK(all.reused == singles.outcomes.scenes);
  CHECK(all.digest == expected);
  const VerifyReport report = verify_database({other / "some.h5", all.outcomes.scenes});
  CHECK(report.problems == std::vector<std::string>{});
  CHECK(report.recomputed == all.outcomes.scenes);
  CHECK(report.largest_recomputed_difference == 0.0);
}

}  // namespace voussoir
