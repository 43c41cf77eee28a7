/// @file Causes that nobody stated. Oracle: the density of the readings under a covariance with the cause's
/// own in it, and chi square, both from their definitions (LDLT).

#include "lookup/unknown/unstated_cause.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <catch2/catch.hpp>
#include <random>

#include "tests/lookup/unknown/explained_readings.h"
#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Changes of the intact bridge, of which the first epoch was read, too, and two causes of one and two
/// columns.
struct ReadWithCauses {
  SyntheticLibrary library{3, 6};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  PossibleCauses possible;

  ReadWithCauses() {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    const auto points = static_cast<Index>(library.points.size());
    possible = {MatrixXd::NullaryExpr(points, 3, [&] { return normal(random); }),
                {{0, 1, 2e-4}, {1, 2, 1e-4}}};
    comparison.kind = ReadingKind::change;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, {}};
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      comparison.measured.displacement[i] =
          library.intact()[i] + 1e-4 * possible.columns(static_cast<Index>(i), 0);
      comparison.measured.sigma[i] = 2e-5;
      comparison.before.push_back(library.intact()[i] + 1e-5);
    }
  }
};

/// In rows of y, what a cause adds at one of the times.
MatrixXd columns_in_rows(const UnknownBridge& bridge, const PossibleCauses& possible, const CauseFit& fit) {
  const auto& [first, count, size] = possible.causes[fit.cause];
  MatrixXd columns(bridge.reading.size(), count);
  for (Index k = 0; k < columns.rows(); ++k) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
    columns.row(k) = size * (fit.first_epoch ? row.before : row.after) *
                     possible.columns.row(static_cast<Index>(row.channel)).segment(first, count);
  }
  return columns;
}

}  // namespace

TEST_CASE("A cause explains readings in its likeliest case as well as its covariance makes them likely") {
  const ReadWithCauses read;
  const UnknownSettings settings{GENERATE(Epochs::change, Epochs::both)};
  const Observation observation = observe(read.comparison, {NoiseShape::gaussian, 0.0}, {});
  const UnknownBridge bridge = unknown_bridge(read.comparison, observation, settings);
  const std::vector<CauseFit> fits =
      cause_fits(bridge, intact_gaussians(bridge, observation, kTwoCases), read.possible);
  REQUIRE(fits.size() == (bridge.has_first_epoch() ? 4 : 2));
  const auto rows = static_cast<double>(bridge.reading.size());
  for (const CauseFit& fit : fits) {
    INFO("cause " << fit.cause << (fit.first_epoch ? ", first time" : ""));
    const MatrixXd columns = columns_in_rows(bridge, read.possible, fit);
    const Explained expected = explained_by(bridge, observation, columns);
    CHECK(fit.log == Approx(expected.log).epsilon(1e-9));

    const UnstatedCause cause = unstated_cause(bridge, read.possible, fit);
    CHECK((cause.covariance - columns * columns.transpose()).norm() < 1e-12 * cause.covariance.norm());
    const MatrixXd intact = intact_covariance_of(bridge, case_noise(bridge, observation, fit.best)),
                   with = intact + cause.covariance;
    const VectorXd mean = columns * expected.amounts;
    CHECK((cause.expected - mean).norm() < 1e-9 * mean.norm());

    const auto chance = [&](const MatrixXd& covariance) {
      const double square = bridge.reading.dot(covariance.ldlt().solve(bridge.reading));
      return cdf(complement(boost::math::chi_squared(rows), square));
    };
    const CauseChances found = cause_chances(bridge, observation, cause);
    CHECK(found.with == Approx(chance(with)).margin(1e-9));
    CHECK(found.without == Approx(chance(intact)).margin(1e-9));
  }
}
