/// @file What readings say of a bridge. Oracle: the conditional Gaussian of parameters and readings, written
/// down jointly and solved by Eigen's LU, factor by factor of the scatter.

#include "lookup/unknown/bridge_posterior.h"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kSigma = 2e-5;  // [m]

/// Absolute readings of an intact bridge that are off in waves.
struct Readings {
  SyntheticLibrary library{3, 4};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  Readings() {
    comparison.factors = factors_of(library, sensitivities);
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      comparison.measured.displacement[i] = library.intact()[i] + 2e-4 * std::cos(static_cast<double>(3 * i));
      comparison.measured.sigma[i] = kSigma;
    }
  }
};

/// Mean and covariance of all parameters and of what joints have softened by, given the readings; kappa by
/// kappa, as far as it `counts`. `conditions`: size of what the file states of epochs.
struct Joint {
  VectorXd mean;
  MatrixXd covariance;
};

Joint joint_gaussian(const Sensitivities& from, double conditions, const VectorXd& reading,
                     const ScatterLogs& counts) {
  const FactorsView of = from.find(0, {}).value();
  const FirstOrderResidual& residual = from.residuals[0];
  const MatrixXd& uneven = from.unevenness[0];
  const Index n = reading.size(), m = of.bridge.cols(), e = of.epoch.cols() + uneven.cols();
  MatrixXd design(n, m + e);
  design << of.bridge, of.epoch, uneven;
  const double left = conditions * std::max(1.0, 2.0 * conditions);  // heavy tails: twice as wide
  const MatrixXd noise = kSigma * kSigma * MatrixXd::Identity(n, n) +
                         residual.bridge * residual.bridge.transpose() +
                         left * left * residual.epoch * residual.epoch.transpose();
  Joint joint{VectorXd::Zero(m + e), MatrixXd::Zero(m + e, m + e)};
  double total = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0.0) continue;  // parts with little weight are left out
    VectorXd prior(m + e);
    prior << VectorXd::Constant(m, kScatterFactors[k]),
        VectorXd::Constant(of.epoch.cols(), conditions * conditions), VectorXd::Ones(uneven.cols());
    const MatrixXd covariance = design * prior.asDiagonal() * design.transpose() + noise;
    const Eigen::FullPivLU<MatrixXd> solver(covariance);
    const MatrixXd gain = prior.asDiagonal() * design.transpose() * solver.inverse();
    const VectorXd own = gain * reading;
    const MatrixXd spread = MatrixXd(prior.asDiagonal()) - gain * design * MatrixXd(prior.asDiagonal());
    const double weight = kScatterPrior[k] * std::exp(-0.5 * reading.dot(solver.solve(reading))) /
                          std::sqrt(MatrixXd(1e9 * covariance).determinant());
    total += weight;
    joint.mean += weight * own;
    joint.covariance += weight * (spread + own * own.transpose());
  }
  joint.mean /= total;
  joint.covariance = joint.covariance / total - joint.mean * joint.mean.transpose();
  return joint;
}

}  // namespace

TEST_CASE(
    "Means and spreads of the parameters are those of the joint Gaussian, however large conditions are") {
  const double conditions = GENERATE(0.2, 1.0, 3.0);
  const Readings readings;
  const Observation observation = observe(readings.comparison, {NoiseShape::gaussian, 0.0}, {});
  const UnknownCase in_case{0.0, conditions};
  const UnknownBridge bridge = unknown_bridge(readings.comparison, observation, {});
  const BridgePosterior posterior =
      bridge_posterior(bridge, observation, readings.library.table, {{0, 1.0}}, {&in_case, 1});
  ScatterLogs counts{};
  for (const BridgePart& part : posterior.parts)
    counts[static_cast<std::size_t>(std::ranges::find(kScatterFactors, part.kappa) -
                                    kScatterFactors.begin())] = part.weight;
  const auto [mean, covariance] = joint_gaussian(readings.sensitivities, conditions, bridge.reading, counts);
  const MatrixXd& basis = readings.sensitivities.basis;
  const Index m = basis.cols();
  const MatrixXd of_columns = covariance.topLeftCorner(m, m);
  for (Index i = 0; i <= m; ++i) {
    const VectorXd row = basis.row(i);
    const ParameterEstimate one = parameter_estimate(posterior, row);
    CHECK(one.mean == Approx(row.dot(mean.head(m))).epsilon(1e-6).margin(1e-9));
    CHECK(one.deviation == Approx(std::sqrt(row.dot(of_columns * row))).epsilon(1e-6));
  }
  for (Index i = 0; i < readings.sensitivities.of_epoch(); ++i) {
    const Index at = m + i;
    CHECK(posterior.epoch_mean[i] == Approx(mean[at]).epsilon(1e-6).margin(1e-9));
    CHECK(posterior.epoch_covariance(i, i) == Approx(covariance(at, at)).epsilon(1e-6));
  }
  const MatrixXd& uneven = readings.sensitivities.unevenness[0];
  CHECK(posterior.from_unevenness.isApprox(uneven * mean.tail(uneven.cols()), 1e-6));
  const VectorXd sum = posterior.signal + posterior.from_bridge + posterior.from_epochs.rowwise().sum() +
                       posterior.from_unevenness + posterior.left;
  CHECK((sum - bridge.reading).norm() < 1e-15);
}
