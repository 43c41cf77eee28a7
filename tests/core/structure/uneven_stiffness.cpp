/// @file Oracles: the correlation's definition by hand, moments of many draws within four standard errors.

#include "core/structure/uneven_stiffness.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

constexpr double kVariation = 0.2;
constexpr int kDraws = 400;

/// Logarithms of what each pair of blocks keeps, a column a draw, in standard deviations.
Eigen::MatrixXd draws(const Model& bridge, const UnevenStiffness& uneven) {
  Eigen::MatrixXd logs(static_cast<Eigen::Index>(uneven.joints.size()), kDraws);
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::ArrayXd shares = sampled_shares(bridge, uneven, static_cast<std::uint64_t>(draw));
    REQUIRE(shares.size() == static_cast<Eigen::Index>(bridge.joints.size()));
    for (std::size_t i = 0; i < uneven.joints.size(); ++i) {
      const std::vector<std::size_t>& stretches = uneven.joints[i].joints;
      const double share = shares[static_cast<Eigen::Index>(stretches.front())];
      for (const std::size_t joint : stretches) REQUIRE(shares[static_cast<Eigen::Index>(joint)] == share);
      logs(static_cast<Eigen::Index>(i), draw) =
          std::log(share) / std::sqrt(std::log1p(kVariation * kVariation));
    }
  }
  return logs;
}

}  // namespace

TEST_CASE("Joints soften alike as far as they are near each other (by hand)", "[uncertainty]") {
  const Model bridge = test::reference_bridge();
  const UnevenStiffness uneven = uneven_stiffness(bridge, {});
  CHECK(uneven.length == 5.0);  // a quarter of 20 m
  REQUIRE(uneven.places.size() == uneven.joints.size());
  CHECK(uneven.joints.front().parameter.sigma == Approx(std::sqrt(std::log(1.0 + 0.03 * 0.03))));
  const Joint& first = bridge.joints[uneven.joints.front().joints.front()];
  const auto ends = ends_of(first, bridge.mesh);
  CHECK(uneven.places.front().isApprox(0.5 * (ends[0] + ends[1])));
  const double distance = (uneven.places[3] - uneven.places[200]).norm();
  REQUIRE(distance > 1.0);
  CHECK(uneven.correlation(3, 200) == Approx(std::exp(-distance / 5.0)));
  CHECK(uneven.correlation(200, 3) == uneven.correlation(3, 200));
  CHECK(uneven.correlation(7, 7) == 1.0);
}

TEST_CASE("Drawn at random joints vary as stated, and together as stated", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const UnevenStiffness uneven = uneven_stiffness(bridge, {.epoch_unevenness = kVariation});
  const Eigen::MatrixXd logs = draws(bridge, uneven);
  const Eigen::MatrixXd found = logs * logs.transpose() / kDraws;
  double worst = 0.0;  // standard errors
  for (Eigen::Index i = 0; i < found.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double stated = uneven.correlation(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      worst = std::max(worst, std::abs(found(i, j) - stated) / std::sqrt((1.0 + stated * stated) / kDraws));
    }
  CHECK(worst < 4.5);  // of some thousand that depend on each other
  const auto shares = [&](std::uint64_t seed) { return sampled_shares(bridge, uneven, seed); };
  CHECK(shares(3).matrix() == shares(3).matrix());
  CHECK(shares(3).matrix() != shares(4).matrix());
}

TEST_CASE("Joints that soften alike are drawn as ones that do not soften more than others", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const UnevenStiffness even = uneven_stiffness(bridge, {.epoch_unevenness = 0.0});
  CHECK(even.joints.empty());
  CHECK(sampled_shares(bridge, even, 1).isOnes(0.0));
}
