/// @file Oracle: moments of many draws within four standard errors.

#include "core/structure/uneven_stiffness.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/structure/joint_correlation.h"
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

TEST_CASE("Drawn at random joints vary as stated, and together as stated", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const UnevenStiffness uneven = uneven_stiffness(bridge, {.epoch_unevenness = kVariation});
  CHECK(uneven.correlations == joint_correlations(bridge, first_joints(uneven.joints)));
  const Eigen::MatrixXd logs = draws(bridge, uneven);
  const Eigen::MatrixXd found = logs * logs.transpose() / kDraws;
  double worst = 0.0;  // standard errors
  for (Eigen::Index i = 0; i < found.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double stated = uneven.correlations(i, j);
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
