/// @file The density under a covariance that is known but for the scatter. Oracle: Eigen's LDLT of the whole
/// matrix.

#include "lookup/unknown/scatter_density.h"
#include "tests/lookup/unknown/dense_normal.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace voussoir;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A covariance of as many columns as rows, and something at every point.
MatrixXd covariance(Index rows, double size, double own) {
  const MatrixXd columns = size * MatrixXd::Random(rows, rows);
  return columns * columns.transpose() + own * MatrixXd::Identity(rows, rows);
}

}  // namespace

TEST_CASE("The density for each kappa is that of Eigen's factorisation, of one noise and of two") {
  const Index rows = GENERATE(1, 3, 4, 15, 78);
  const VectorXd shown = 3.0 * VectorXd::Random(rows);
  const std::vector<double> difference(shown.begin(), shown.end());
  const std::array<MatrixXd, 2> noises = {covariance(rows, 0.3, 0.5), covariance(rows, 1.0, 0.1)};
  const MatrixXd bridge = covariance(rows, 2.0, 0.0);
  ScatterDensity density;
  const auto both = density(difference, lower_of(noises[0]), lower_of(noises[1]), lower_of(bridge));
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
      CHECK(both[i][k] ==
            Approx(test::log_normal(shown, noises[i] + kScatterFactors[k] * bridge)).epsilon(1e-10));
    CHECK(density(difference, lower_of(noises[i]), lower_of(bridge)) == both[i]);  // to the last bit
  }
}

TEST_CASE("What is no covariance has no density") {
  const MatrixXd noise = -MatrixXd::Identity(5, 5), bridge = MatrixXd::Identity(5, 5);
  const auto logs = ScatterDensity()(std::vector<double>(5, 1.0), lower_of(noise), lower_of(bridge));
  CHECK(std::isnan(logs[0]));        // kappa 1/4: negative
  CHECK_FALSE(std::isnan(logs[3]));  // kappa 4: 3 times the identity
}
