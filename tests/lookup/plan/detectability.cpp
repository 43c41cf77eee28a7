/// @file Oracle: the same by brute force: other draws, dense densities, probabilities by their definition.

#include "lookup/plan/detectability.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "lookup/plan/loss_gaussian.h"
#include "tests/lookup/plan/planned_bridge.h"
#include "tests/lookup/unknown/dense_normal.h"

using namespace voussoir;
using Eigen::Index;
using Eigen::VectorXd;
using test::PlannedBridge;

namespace {

constexpr int kDraws = 400;

SightSettings settings() {
  SightSettings settings;
  settings.log_prior_intact = std::log(0.9);
  settings.log_prior_loss = std::log(0.01);
  settings.log_silence = std::log(0.1);
  settings.certain = 0.8;
  settings.draws = kDraws;
  return settings;
}

/// Density times prior of readings, given which sensors are silent; 0 if that cannot be.
double weight(const PlannedBridge& planned, std::optional<BlockId> lost, const std::vector<Index>& rows,
              const VectorXd& readings) {
  const LossGaussian loss = loss_gaussian(planned.bridge, planned.noise, lost);
  const VectorXd mean = loss.signal(rows);
  if (mean.hasNaN()) return 0.0;
  const auto silent = static_cast<double>(rows_with_reading(loss.signal).size() - rows.size());
  const double share = lost ? std::exp(planned.bridge.loss_of(*lost).log_weight) : 1.0;
  return (lost ? 0.01 * share : 0.9) * std::pow(0.1, silent) *
         std::exp(test::log_normal(readings - mean, Eigen::MatrixXd(loss.covariance(rows, rows))) -
                  10.0 * static_cast<double>(rows.size()));  // within range
}

struct Shares {
  double seen = 0.0, named = 0.0;
};

Shares by_brute_force(const PlannedBridge& planned, BlockId block, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const LossGaussian loss = loss_gaussian(planned.bridge, planned.noise, block);
  const std::vector<Index> rows = rows_with_reading(loss.signal);
  const Eigen::MatrixXd root = Eigen::MatrixXd(loss.covariance(rows, rows)).llt().matrixL();
  Shares shares;
  for (int draw = 0; draw < kDraws; ++draw) {
    const VectorXd standard = VectorXd::NullaryExpr(root.rows(), [&] { return normal(random); });
    const VectorXd readings = loss.signal(rows) + root * standard;
    const double intact = weight(planned, std::nullopt, rows, readings);
    double all = intact;
    for (const BlockId other : blocks_with_sensitivities(planned.bridge))
      all += weight(planned, other, rows, readings);
    shares.seen += intact / all <= 0.2 ? 1.0 / kDraws : 0.0;
    shares.named += weight(planned, block, rows, readings) / all >= 0.8 ? 1.0 / kDraws : 0.0;
  }
  return shares;
}

/// Four standard errors of the difference of two shares of so many draws each.
double allowed(double one, double other) {
  const double p = std::clamp(0.5 * (one + other), 0.01, 0.99);
  return 4.0 * std::sqrt(2.0 * p * (1.0 - p) / kDraws);
}

}  // namespace

TEST_CASE("Losses are seen and named as often as in draws by brute force", "[plan]") {
  PlannedBridge planned(2e-5);
  planned.bridge.losses[6].log_weight = std::log(1e-3);  // as if few bridges survived it
  std::mt19937_64 random(5);
  const std::vector<Sight> sights = sights_of(planned.bridge, planned.noise, settings());
  REQUIRE(sights.size() == 11);
  double most = 0.0, least = 1.0;
  for (const Sight& sight : sights) {
    const Shares expected = by_brute_force(planned, sight.block, random);
    CHECK(std::abs(sight.seen - expected.seen) <= allowed(sight.seen, expected.seen));
    CHECK(std::abs(sight.named - expected.named) <= allowed(sight.named, expected.named));
    CHECK(sight.silent == (sight.block >= BlockId{8} ? 2 : 0));
    most = std::max(most, sight.named);
    least = std::min(least, sight.named);
  }
  CHECK(most - least > 0.2);  // or shares would say nothing
}

TEST_CASE("The same seed gives the same shares; smaller errors show more", "[plan]") {
  const auto seen = [](double sigma) {
    double sum = 0.0;
    const PlannedBridge planned(sigma);
    for (const Sight& sight : sights_of(planned.bridge, planned.noise, settings())) sum += sight.seen;
    return sum;
  };
  CHECK(seen(2e-5) == seen(2e-5));
  CHECK(seen(1e-6) > seen(2e-5));
  CHECK(seen(2e-5) > seen(1e-3));
}

TEST_CASE("A loss that silences the only sensors is seen by their silence alone (by hand)", "[plan]") {
  PlannedBridge planned(2e-5);
  for (std::size_t i = 0; i < planned.library.points.size(); ++i)  // points 3 and 4 are on block 9
    if (i != 2 && i != 3) planned.comparison.measured.displacement[i] = std::nan("");
  planned.look_at(observe(planned.comparison, {NoiseShape::gaussian, 0.0}));
  const std::vector<Sight> sights = sights_of(planned.bridge, planned.noise, settings());
  const auto on_top = std::ranges::find(sights, BlockId{9}, &Sight::block);
  REQUIRE(on_top != sights.end());
  CHECK(on_top->silent == 2);
  // 0.01 beside 0.9 and ten other losses of 0.01, whose sensors both fall silent with a chance of 0.01: of
  // the sum .01 + .01 (.9 + .1) = .02 the intact bridge has .009, the block itself .01.
  CHECK(on_top->named == 0.0);
  CHECK(on_top->seen == 0.0);
  SightSettings surer = settings();
  surer.certain = 0.49;
  CHECK(sights_of(planned.bridge, planned.noise, surer)[static_cast<std::size_t>(on_top - sights.begin())]
            .named == 1.0);
}
