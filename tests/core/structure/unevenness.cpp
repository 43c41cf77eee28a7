/// @file Oracle: moments of many draws within four standard errors.

#include "core/structure/unevenness.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/structure/correlation_by_distance.h"
#include "tests/support/bridges.h"
#include "tests/support/covariance_of_draws.h"

using namespace voussoir;

namespace {

constexpr double kVariation = 0.2, kWarmth = 4.0;
constexpr int kDraws = 400;

/// In standard deviations, a column a draw.
struct Draws {
  Eigen::MatrixXd stiffness;  ///< logarithms of what each pair of blocks keeps
  Eigen::MatrixXd warmth;     ///< of each block
};

Draws draws(const Model& bridge, const Unevenness& uneven) {
  Draws result{Eigen::MatrixXd(static_cast<Eigen::Index>(uneven.stiffness.actions.size()), kDraws),
               Eigen::MatrixXd(static_cast<Eigen::Index>(uneven.temperature.actions.size()), kDraws)};
  for (int draw = 0; draw < kDraws; ++draw) {
    const Stage stage = with_unevenness({}, bridge, uneven, static_cast<std::uint64_t>(draw));
    REQUIRE(stage.joint_stiffness.size() == static_cast<Eigen::Index>(bridge.joints.size()));
    for (std::size_t i = 0; i < uneven.stiffness.actions.size(); ++i) {
      const std::vector<std::size_t>& stretches = uneven.stiffness.actions[i].joints;
      const double share = stage.joint_stiffness[static_cast<Eigen::Index>(stretches.front())];
      for (const std::size_t joint : stretches)
        REQUIRE(stage.joint_stiffness[static_cast<Eigen::Index>(joint)] == share);
      result.stiffness(static_cast<Eigen::Index>(i), draw) =
          std::log(share) / std::sqrt(std::log1p(kVariation * kVariation));
    }
    result.warmth.col(draw) = stage.uneven_temperature / kWarmth;
  }
  return result;
}

}  // namespace

TEST_CASE("Drawn at random joints and warmth vary as stated, and together as stated", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const Unevenness uneven =
      unevenness_of(bridge, {.epoch_unevenness = kVariation, .uneven_temperature = kWarmth});
  CHECK(uneven.stiffness.correlations ==
        correlations_by_distance(bridge, places_of(uneven.stiffness.actions, bridge)));
  CHECK(uneven.temperature.actions.size() == bridge.layout.size());
  const Draws drawn = draws(bridge, uneven);
  CHECK(test::worst_covariance_error(drawn.stiffness, uneven.stiffness.correlations) <
        4.5);  // of thousands that depend on
  CHECK(test::worst_covariance_error(drawn.warmth, uneven.temperature.correlations) < 4.5);  // each other
  const auto warmth = [&](std::uint64_t seed) {
    return with_unevenness({}, bridge, uneven, seed).uneven_temperature.matrix().eval();
  };
  CHECK(warmth(3) == warmth(3));
  CHECK(warmth(3) != warmth(4));
}

TEST_CASE("Joints are where they lie, and as uncertain as stated (by hand)", "[uncertainty]") {
  const Model bridge = test::reference_bridge();
  const Unevenness uneven = unevenness_of(bridge, {});
  const std::vector<UncertainAction>& actions = uneven.stiffness.actions;
  CHECK(actions.front().parameter.sigma == Approx(std::sqrt(std::log(1.0 + 0.03 * 0.03))));
  CHECK(uneven.temperature.actions.front().parameter.sigma == 1.0);
  const std::vector<Point> places = places_of(actions, bridge);
  REQUIRE(places.size() == actions.size());
  const auto ends = ends_of(bridge.joints[actions.front().joints.front()], bridge.mesh);
  CHECK(places.front().isApprox(0.5 * (ends[0] + ends[1])));
  const double distance = (places[3] - places[200]).norm();
  REQUIRE(distance > 1.0);
  CHECK(uneven.stiffness.correlations(3, 200) == Approx(std::exp(-distance / 5.0)));  // a quarter of 20 m
}

TEST_CASE("Where all is even a stage stays as it is", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const Unevenness even = unevenness_of(bridge, {.epoch_unevenness = 0.0, .uneven_temperature = 0.0});
  CHECK(even.is_none());
  const Stage stage = with_unevenness({.temperature = 2.0}, bridge, even, 1);
  CHECK(stage.joint_stiffness.size() == 0);
  CHECK(stage.uneven_temperature.size() == 0);
  CHECK(temperature_of(stage, 3) == 2.0);
}
