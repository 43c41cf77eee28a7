/// @file Histories of bridges that are drawn at random. Oracle: each stage of each bridge solved by itself.

#include "generator/uncertainty/sampled_histories.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/solve/combined_solver.h"
#include "tests/support/bridges.h"
#include "tools/validation/history.h"

namespace voussoir {
namespace {

/// A study of a bridge, with the answers of the nominal one.
struct Sampling {
  Sampling(const BridgeDescription& one, const std::vector<Scene>& few_scenes,
           std::initializer_list<std::uint64_t> seeds)
      : description(one),
        bridge(make_model(description)),
        plan(plan_states({"built", "lost"}, bridge, description)),
        settings(solver.settings(bridge)),
        scenes(few_scenes) {
    states = StateSolving(bridge, plan).states_from_intact(solver.make_solver(bridge, settings), scenes);
    for (const std::uint64_t seed : seeds)
      drawn.push_back(draw_bridge(bridge, uncertain_parameters(bridge, description.uncertainty), seed));
  }

  std::vector<SampledScene> solve() const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < scenes.size(); ++i) all.push_back(i);
    const SensitivityStudy study{description, bridge, plan, solver, settings, 1};
    return SampledHistories(study, scenes).solve(drawn, all);
  }

  SolverChoice solver = quasi_static();
  BridgeDescription description;
  Model bridge;
  StatePlan plan;
  std::string settings;
  std::vector<Scene> scenes;
  std::vector<SceneStates> states;
  std::vector<SampledBridge> drawn;
};

validation::NamedStage without(Stage stage, const Scene& scene) {
  stage.scene = scene;
  return {"", std::move(stage)};
}

/// The stages, and then the parts in which the scene enters the epoch.
std::vector<validation::NamedStage> with_epoch(std::vector<validation::NamedStage> stages, const Stage& epoch,
                                               const Scene& scene) {
  const int parts = scene.removed.empty() ? kPartsOfEpoch : kPartsOfEpochWithout;
  for (int part = 1; part <= parts; ++part) {
    const double share = part / static_cast<double>(parts);
    validation::NamedStage next = without(epoch, scene);
    next.stage.temperature *= share;
    next.stage.support_movement *= share;
    next.stage.joint_stiffness = epoch.joint_stiffness.pow(share);
    stages.push_back(std::move(next));
  }
  return stages;
}

/// Relative to the largest reading; 0 where both do not stand.
double difference(const Eigen::VectorXd& found, const Model& bridge, const Solution& expected) {
  CHECK(stands(expected) == (found.size() > 0));
  if (!stands(expected) || found.size() == 0) return 0.0;
  const Eigen::VectorXd readings = test::readings(bridge, expected.displacement);
  return (found - readings).array().isNaN().select(0.0, found - readings).cwiseAbs().maxCoeff() /
         readings.array().isNaN().select(0.0, readings).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("Joints of sampled bridges vary together as stated (variance of their mean in 400 bridges)") {
  const Model bridge = test::small_bridge();
  const UncertainParameters uncertain = uncertain_parameters(bridge, {});
  constexpr Eigen::Index common = 5;  // that all joints and blocks share
  const auto pairs = static_cast<Eigen::Index>(uncertain.of_bridge.size()) - common;
  const Eigen::MatrixXd own = uncertain.correlation_factor.bottomRightCorner(pairs, pairs);
  const double stated = (own.transpose() * Eigen::VectorXd::Ones(pairs)).squaredNorm();
  CHECK(stated > 5.0 * static_cast<double>(pairs));  // what it would be if they did not
  constexpr int draws = 400;
  double found = 0.0;
  for (std::uint64_t seed = 0; seed < draws; ++seed)
    found += std::pow(draw_bridge(bridge, uncertain, seed).of_bridge.tail(pairs).sum(), 2) / draws;
  CHECK(found == Approx(stated).epsilon(4.0 * std::sqrt(2.0 / draws)));
}

TEST_CASE("Sampled bridges are built, enter their epoch and lose blocks in it (stage by stage)") {
  const BlockLayout layout = test::small_bridge().layout;
  const Sampling sampling(test::small_description(),
                          {Scene{}, parse_scene("4,2", layout), parse_scene("2,1", layout)}, {11, 12});
  const std::vector<SampledScene> found = sampling.solve();
  REQUIRE(found.size() == 6);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const SampledBridge& sample = sampling.drawn[i / 3];
    const Scene& scene = sampling.scenes[i % 3];
    const Model bridge = with_parameters(sampling.bridge, sample.parameters);
    QuasiStaticSolver solver(bridge);
    const auto end_of = [&](const std::vector<validation::NamedStage>& stages) {
      return validation::solve_history(solver, {"", stages}).back();
    };
    const auto check = [&](const Eigen::VectorXd& moved, const std::vector<validation::NamedStage>& stages) {
      CHECK(difference(moved, bridge, end_of(stages)) < 1e-5);
    };
    check(found[i].at_rest[0], {without({}, scene)});
    check(found[i].at_rest[1], {without({}, {}), without({}, scene)});
    check(found[i].in_epoch[0], with_epoch({without({}, scene)}, sample.epoch, scene));
    std::vector<validation::NamedStage> lost = with_epoch({without({}, {})}, sample.epoch, {});
    if (!scene.removed.empty()) lost.push_back(without(sample.epoch, scene));
    check(found[i].in_epoch[1], lost);
  }
}

TEST_CASE(
    "Sampled bridges that stand by what they slid have each slid their own, and go on from it (in motion)",
    "[many-solutions]") {
  const Sampling sampling(test::slid_description(), {Scene{}}, {9, 8});  // both slide
  const Solution& nominal = *sampling.states[0][kBuilt];
  REQUIRE(stands(nominal));
  REQUIRE(has_slipped(nominal));
  CHECK_FALSE(sampling.drawn[0].slowly);
  CHECK(sampling.drawn[1].slowly);
  const std::vector<SampledScene> found = sampling.solve();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const SampledBridge& sample = sampling.drawn[i];
    const Model bridge = with_parameters(sampling.bridge, sample.parameters);
    SolverSettings settings = SolverSettings::of(SolverKind::quasi_static);
    if (sample.slowly) settings.motion.ramp = 2.0;
    const StageTask built{.stage = {}};
    const Solution at_rest =
        CombinedSolver(bridge, acting_settings(settings, bridge)).solve({&built, 1}).front();
    REQUIRE(has_slipped(at_rest));
    CHECK(difference(found[i].at_rest[0], bridge, at_rest) < 1e-5);
    QuasiStaticSolver solver(bridge);
    Solution in_epoch = at_rest;
    for (const validation::NamedStage& part : with_epoch({}, sample.epoch, {})) {
      const Solution before = in_epoch;
      in_epoch =
          solver.solve(StageTask{.stage = part.stage, .start = &before.displacement, .before = &before});
    }
    CHECK(difference(found[i].in_epoch[0], bridge, in_epoch) < 1e-5);
    const Solution with_slip_of_nominal =
        solver.solve(StageTask{.stage = {}, .start = &nominal.displacement, .slipped = &nominal.slipped});
    CHECK_FALSE((stands(with_slip_of_nominal) &&
                 difference(found[i].at_rest[0], bridge, with_slip_of_nominal) < 1e-2));
  }
}

}  // namespace voussoir
