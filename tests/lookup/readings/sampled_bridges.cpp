/// @file Factors from sampled bridges. Oracle: covariances summed up from their definition.

#include "lookup/readings/sampled_bridges.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/lookup/readings/sampled_site.h"

using namespace voussoir;
using namespace voussoir::test;
using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The mean of r r^T over variants, r being what the columns leave of how far they are from the nominal
/// bridge.
MatrixXd mean_square(const Database& database, std::size_t state, const Scene& scene,
                     const std::vector<std::int32_t>& variants, const Sensitivities* first_order) {
  const auto p = static_cast<Index>(database.control_points().size());
  MatrixXd sum = MatrixXd::Zero(2 * p, 2 * p);
  for (const std::int32_t variant : variants) {
    VectorXd left = difference_of(database, variant, state, scene);
    if (first_order != nullptr) left -= columns_of(*first_order, state, scene) * position_of(variant);
    sum += left * left.transpose();
  }
  return sum / static_cast<double>(variants.size());
}

MatrixXd covariance(const SampledBridges& sampled, std::size_t state, const Scene& scene) {
  const MatrixXd columns = columns_of(sampled.sensitivities, state, scene);
  return columns * columns.transpose();
}

std::vector<std::int32_t> numbers_to(std::int32_t count, std::int32_t without = 0) {
  std::vector<std::int32_t> numbers;
  for (std::int32_t i = 1; i <= count; ++i)
    if (i != without) numbers.push_back(i);
  return numbers;
}

}  // namespace

TEST_CASE("Factors of sampled bridges alone have the samples' covariance about the nominal bridge") {
  const Site site({.variants = 24, .difference = scattered});
  const SampledBridges sampled = sampled_bridges(site.database());
  CHECK(sampled.count == 24);
  CHECK_FALSE(sampled.has_first_order);
  CHECK(sampled.sensitivities.parameters.empty());
  int compared = 0;
  for (std::size_t state = 0; state < kStates; ++state)
    for (const int block : {0, 3, 12, 37}) {
      const MatrixXd expected = mean_square(site.database(), state, single(block), numbers_to(24), nullptr);
      CHECK(covariance(sampled, state, single(block)).isApprox(expected, 1e-10));
      ++compared;
    }
  CHECK(compared == 8);
}

TEST_CASE("Beside the first order samples add what it leaves of each of them") {
  const Sensitivities first = first_order_of_stored_bridge();
  const Site site({.difference = scattered, .first_order = first});
  const SampledBridges sampled = sampled_bridges(site.database());
  CHECK(sampled.count == 12);
  CHECK(sampled.has_first_order);
  for (std::size_t state = 0; state < kStates; ++state)
    for (const int block : {3, 12}) {
      const MatrixXd columns = columns_of(first, state, single(block));
      const MatrixXd expected = columns * columns.transpose() +
                                mean_square(site.database(), state, single(block), numbers_to(12), &first);
      CHECK(covariance(sampled, state, single(block)).isApprox(expected, 1e-10));
      const auto left = [&](const Sensitivities& of) { return of.find(state, single(block)).value().left; };
      CHECK(left(sampled.sensitivities) == left(first));  // epochs are not sampled
      CHECK_FALSE(left(first).isZero());
    }
  const FirstOrderResidual& residual = sampled.sensitivities.residuals[1];
  CHECK(residual.bridge.cols() == 0);
  CHECK(residual.share == 0.0);
  CHECK(residual.common == 0.0);
  CHECK(residual.epoch == first.residuals[1].epoch);
  CHECK(residual.epoch_share == 0.1);
}

TEST_CASE("What readings say of parameters they say through the first order's columns alone") {
  const Sensitivities first = first_order_of_stored_bridge();
  const Site site({.difference = scattered, .first_order = first});
  const Sensitivities made = sampled_bridges(site.database()).sensitivities;
  CHECK(made.parameters == first.parameters);
  // theta = V z: what a scene's readings share with the parameters is A V^T.
  for (const int block : {3, 12}) {
    const MatrixXd expected = first.find(1, single(block))->bridge * first.basis.transpose();
    CHECK((made.find(1, single(block))->bridge * made.basis.transpose()).isApprox(expected, 1e-12));
  }
}

TEST_CASE(
    "Scenes that fall in a sampled bridge have the others, or the widened first order if few are left") {
  const Sensitivities first = first_order_of_stored_bridge();
  const int once = 12, often = 3;
  const Site site({.difference = scattered, .first_order = first, .falls = [&](const RecordKey& key) {
                     return (key.variant == 5 && key.scene == single(once)) ||
                            (key.variant > 9 && key.scene == single(often));
                   }});
  const Database& database = site.database();
  const SampledBridges sampled = sampled_bridges(database);
  const auto p = static_cast<Index>(database.control_points().size());
  const MatrixXd of_once = columns_of(first, 1, single(once)),
                 widened = columns_of(first, 1, single(often), std::sqrt(1.0 + 0.3 * 0.3 + 0.4 * 0.4));
  const MatrixXd expected =
      of_once * of_once.transpose() + mean_square(database, 1, single(once), numbers_to(12, 5), &first);
  CHECK(covariance(sampled, 1, single(once))
            .bottomRightCorner(p, p)
            .isApprox(expected.bottomRightCorner(p, p), 1e-10));
  CHECK(covariance(sampled, 1, single(often))
            .bottomRightCorner(p, p)
            .isApprox((widened * widened.transpose()).bottomRightCorner(p, p), 1e-10));
}

TEST_CASE("What sampled bridges cannot tell is said, with what to do") {
  const Site none({.variants = 0}), few({.variants = 9, .difference = scattered}),
      intact_only({.variants = 20, .difference = scattered, .most_missing = 0}),
      alone({.variants = 20, .difference = scattered});
  CHECK_THROWS_WITH(sampled_bridges(none.database()),
                    Contains("made-up.h5") && Contains("no sampled bridge") && Contains("--variants"));
  CHECK_THROWS_WITH(sampled_bridges(few.database()),
                    Contains("9 sampled bridges") && Contains("at least 20") && Contains("--variants"));
  CHECK_THROWS_WITH(sampled_bridges(intact_only.database()), Contains("--scenes singles"));
  CHECK(sampled_bridges(few.database(), ScatterEvidence::first_order) == nullptr);
  // Sensitivities of other parameters than the bridge file's.
  Sensitivities other = first_order_of_stored_bridge();
  other.parameters.front().sigma *= 2.0;
  const Site changed({.difference = scattered, .first_order = other});
  CHECK_THROWS_WITH(sampled_bridges(changed.database()), Contains("other parameters"));
}
