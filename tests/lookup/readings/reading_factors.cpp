/// @file Factors of readings. Oracle: the same sensitivities in memory, from which signals are made anew, and
/// the products that define them.

#include "lookup/readings/reading_factors.h"

#include <catch2/catch.hpp>

#include "tests/lookup/readings/sampled_site.h"

namespace voussoir {
namespace {

using namespace test;
using Eigen::MatrixXd;

std::shared_ptr<const ReadingFactors> factors_of(const Sensitivities& sensitivities,
                                                 const std::vector<Channel>& channels) {
  return reading_factors(sensitivities, 0, channels, stored_bridge().layout.size());
}

MatrixXd across(const LossFactors& loss) {
  return loss.intact.all() * loss.own.all().transpose();
}

/// Of all control points, or of every third.
std::vector<Channel> channels_at(std::size_t step) {
  std::vector<Channel> channels;
  for (std::size_t point = 0; point < stored_bridge().control_points.size(); point += step)
    channels.push_back({nullptr, point});
  return channels;
}

void check_same(const ReadingFactors& stored, const ReadingFactors& made) {
  CHECK(stored.intact.bridge == made.intact.bridge);
  CHECK(stored.intact_product.isApprox(made.intact.bridge * made.intact.bridge.transpose(), 1e-14));
  CHECK(stored.signal_product.isApprox(made.signal_product, 1e-12));
  int known = 0;
  for (std::size_t block = 0; block < stored.blocks.size(); ++block) {
    const LossFactors &one = stored.blocks[block], &other = made.blocks[block];
    REQUIRE(one.known() == other.known());
    if (!one.known()) continue;
    ++known;
    REQUIRE(one.lead.all() == other.lead.all());
    REQUIRE(one.lead.leading(2) == other.lead.all().leftCols(2));
    REQUIRE(one.own.leading(2) == one.own.all().leftCols(2));
    REQUIRE(one.epoch == other.epoch);
    REQUIRE(product_with_itself(one.own.all()).isApprox(product_with_itself(other.own.all()), 1e-12));
    REQUIRE(across(one).isApprox(across(other), 1e-9));
  }
  CHECK(known == 38);
}

}  // namespace

TEST_CASE("Factors of readings are the same whether their signals stand in the file or are made anew") {
  const Sensitivities made = first_order_of_stored_bridge();
  const Site site({.difference = scattered, .first_order = made});
  const Sensitivities& stored = *site.database().sensitivities();
  REQUIRE(stored.signals);
  REQUIRE_FALSE(made.signals);
  for (const std::size_t step : {1, 3}) {
    const auto channels = channels_at(step);
    check_same(*factors_of(stored, channels), *factors_of(made, channels));
  }
}

TEST_CASE("Stored signals are of single states: where loads are read they are made anew") {
  const Sensitivities made = first_order_of_stored_bridge();
  const Site site({.difference = scattered, .first_order = made});
  auto channels = channels_at(2);
  channels[1].loaded = 1;
  check_same(*factors_of(*site.database().sensitivities(), channels), *factors_of(made, channels));
  const auto factors = factors_of(made, channels);
  const MatrixXd unloaded = made.find(0, {})->bridge, loaded = made.find(1, {})->bridge;
  CHECK(factors->intact.bridge.row(0) == unloaded.row(0));
  CHECK(factors->intact.bridge.row(1) == loaded.row(2) - unloaded.row(2));
}

TEST_CASE("What the first order leaves of a load is the difference of columns that both states share") {
  Sensitivities made = first_order_of_stored_bridge();
  made.residuals[1].bridge *= 3.0;
  made.residuals[1].epoch *= 0.5;
  const auto channels = [] {
    auto all = channels_at(1);
    for (std::size_t k = 1; k < all.size(); k += 2) all[k].loaded = 1;
    return all;
  }();
  const auto factors = factors_of(made, channels);
  for (const auto columns : {&FirstOrderResidual::bridge, &FirstOrderResidual::epoch}) {
    const MatrixXd &unloaded = made.residuals[0].*columns, &loaded = made.residuals[1].*columns;
    REQUIRE(loaded != unloaded);
    CHECK((factors->residual.*columns).row(0) == unloaded.row(0));
    CHECK((factors->residual.*columns).row(1).isApprox(loaded.row(1) - unloaded.row(1), 1e-15));
  }
  made.residuals[1].share = 3.0;
  CHECK(factors_of(made, channels)->residual.share == 3.0);
  CHECK(factors_of(made, channels_at(1))->residual.share == made.residuals[0].share);
}

}  // namespace voussoir
