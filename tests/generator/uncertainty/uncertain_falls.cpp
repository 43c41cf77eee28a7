/// @file Losses after which the bridge falls as its file states it, but may stand. Oracle: other bridges
/// drawn at random, each solved as a nominal one.

#include "generator/uncertainty/uncertain_falls.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "generator/uncertainty/scene_derivatives.h"
#include "tests/support/bridges.h"

namespace voussoir {
namespace {

/// The small bridge, intact and without some blocks.
struct Study {
  explicit Study(const std::vector<std::string>& losses)
      : description(test::small_description()),
        bridge(make_model(description)),
        plan(plan_states({"built", "lost"}, bridge, description)),
        settings(solver.settings(bridge)),
        uncertain(uncertain_parameters(bridge, description.uncertainty)) {
    for (const std::string& loss : losses) scenes.push_back(parse_scene(loss, bridge.layout));
    states = states_of(bridge);
    const SensitivityEquations equations(bridge, uncertain);
    SceneDerivatives worker(study(), equations);
    for (std::size_t state = 0; state < plan.size(); ++state) {
      derivatives.emplace_back();
      for (std::size_t i = 0; i < scenes.size(); ++i)
        derivatives.back().push_back(worker.of(scenes[i], state, states[i], states.front()));
    }
  }

  SensitivityStudy study() const { return {description, bridge, plan, solver, settings, 1}; }
  std::vector<SceneStates> states_of(const Model& model) const {
    return StateSolving(model, plan).states_from_intact(solver.make_solver(model, settings), scenes);
  }
  std::vector<SampledFall> falls() const {
    Progress quiet(Progress::Mode::quiet);
    return find_uncertain_falls(study(), uncertain, {{scenes, states}, derivatives}, quiet);
  }

  SolverChoice solver = for_outcomes();
  BridgeDescription description;
  Model bridge;
  StatePlan plan;
  std::string settings;
  UncertainParameters uncertain;
  std::vector<Scene> scenes;
  std::vector<SceneStates> states;
  Derivatives derivatives;
};

double root_mean_square(const Eigen::VectorXd& values) {
  const Eigen::VectorXd finite = values.array().isNaN().select(0.0, values);
  return std::sqrt(finite.squaredNorm() / static_cast<double>(values.size()));
}

/// What bridges show that the fall was not found from.
struct OtherBridges {
  int bridges = 0;
  std::vector<double> errors;  // of the signal, as shares of it
};

OtherBridges other_bridges(const Study& study, const SampledFall& fall) {
  OtherBridges found;
  for (std::uint64_t seed = 501; seed <= 524; ++seed) {
    const SampledBridge sample = draw_bridge(study.bridge, study.uncertain, seed);
    const auto states = study.states_of(with_parameters(study.bridge, sample.parameters));
    ++found.bridges;
    const auto& single = states[fall.scene][fall.state];
    if (!single || !stands(*single)) continue;
    const auto& points = study.bridge.control_points;
    const Eigen::VectorXd shown = readings_at(points, single->displacement),
                          intact = readings_at(points, states[0][kBuilt]->displacement);
    const Eigen::VectorXd expected =
        fall.fall.if_standing + fall.derivatives.leftCols(sample.of_bridge.size()) * sample.of_bridge;
    found.errors.push_back(root_mean_square(shown - expected) / root_mean_square(shown - intact));
  }
  return found;
}

}  // namespace

TEST_CASE("A loss that only some bridges survive is found, and what others of these show (solved anew)",
          "[sensitivity][many-solutions]") {
  const Study study({"intact", "3,2", "4,2", "0,5"});
  REQUIRE_FALSE(stands(*study.states[1][kBuilt]));
  const std::vector<SampledFall> falls = study.falls();
  REQUIRE(falls.size() == 2);  // the loss of 4,2 leaves the bridge standing, that of the voussoir never does
  for (std::size_t state = 0; state < 2; ++state) {
    const SampledFall& one = falls[state];
    CHECK(one.scene == 1);
    CHECK(one.state == state);
    OtherBridges others = other_bridges(study, one);
    const double share = static_cast<double>(others.errors.size()) / others.bridges;
    const double p = 0.5 * (share + one.fall.standing_share);
    CHECK(std::abs(share - one.fall.standing_share) <
          3.0 * std::sqrt(p * (1.0 - p) * (1.0 / kBridgesOfFalls + 1.0 / others.bridges)));
    std::ranges::sort(others.errors);
    REQUIRE(others.errors.size() > 4);
    CHECK(others.errors[others.errors.size() / 2] < 0.5);
  }
}

TEST_CASE("Without a solver of equilibria nothing is known of falls", "[sensitivity]") {
  Study study({"intact", "3,2"});
  study.solver.make_equilibrium_solver = nullptr;
  CHECK(study.falls().empty());
}

}  // namespace voussoir
