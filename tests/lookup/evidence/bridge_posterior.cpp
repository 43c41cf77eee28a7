/// @file What readings say of a bridge. Oracle: the conditional Gaussian of parameters and readings, written down
/// jointly and solved by Eigen's LU, factor by factor of the scatter.

#include "lookup/evidence/bridge_posterior.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "tests/lookup/evidence/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("Means and spreads of the parameters are those of the joint Gaussian") {
  const SyntheticLibrary library(3, 4);
  const Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  comparison.factors = factors_of(library, sensitivities);
  const auto n = static_cast<Index>(library.points.size());
  const auto intact = library.intact();
  for (std::size_t i = 0; i < library.points.size(); ++i) {
    comparison.measured.displacement[i] = intact[i] + 2e-4 * std::cos(static_cast<double>(3 * i));
    comparison.measured.sigma[i] = 2e-5;
  }
  const Observation observation = observe(comparison, {NoiseShape::gaussian, 0.0}, {});
  const UnknownBridge bridge = unknown_bridge(comparison, observation, 0.0, {});
  const BridgePosterior posterior = bridge_posterior(bridge, observation, library.table, {{0, 1.0}});

  const SceneFactors& of = sensitivities.states[0].scenes[0];
  const FirstOrderResidual& residual = sensitivities.states[0].residual;
  const Index m = of.bridge.cols(), e = of.epoch.cols();
  VectorXd mean = VectorXd::Zero(m + e);
  MatrixXd second = MatrixXd::Zero(m + e, m + e);
  double total = 0.0;
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k) {
    VectorXd prior(m + e);
    prior << VectorXd::Constant(m, kScatterFactors[k]), VectorXd::Ones(e);
    MatrixXd design(n, m + e);
    design << of.bridge, of.epoch;
    const MatrixXd noise = 4e-10 * MatrixXd::Identity(n, n) + residual.bridge * residual.bridge.transpose() +
                           residual.epoch * residual.epoch.transpose();
    const MatrixXd covariance = design * prior.asDiagonal() * design.transpose() + noise;
    const Eigen::FullPivLU<MatrixXd> solver(covariance);
    const MatrixXd gain = prior.asDiagonal() * design.transpose() * solver.inverse();
    const VectorXd own = gain * bridge.reading;
    const MatrixXd spread = MatrixXd(prior.asDiagonal()) - gain * design * MatrixXd(prior.asDiagonal());
    const double weight = kScatterPrior[k] * std::exp(-0.5 * bridge.reading.dot(solver.solve(bridge.reading))) /
                          std::sqrt(MatrixXd(1e9 * covariance).determinant());
    // Parts with less than 2 % of the weight are left out.
    if (posterior.scatter[k] == 0.0) continue;
    total += weight;
    mean += weight * own;
    second += weight * (spread + own * own.transpose());
  }
  mean /= total;
  const MatrixXd covariance = second / total - mean * mean.transpose();
  for (Index i = 0; i < m; ++i) {
    const ParameterEstimate one = parameter_estimate(posterior, sensitivities.basis.row(i));
    CHECK(one.mean == Approx(mean[i]).epsilon(1e-6).margin(1e-9));
    CHECK(one.deviation == Approx(std::sqrt(covariance(i, i))).epsilon(1e-6));
  }
  // Of a parameter outside the basis the readings say only what they say of the scatter.
  const ParameterEstimate outside = parameter_estimate(posterior, sensitivities.basis.row(m));
  CHECK(outside.mean == 0.0);
  for (Index i = 0; i < e; ++i) {
    CHECK(posterior.epoch_mean[i] == Approx(mean[m + i]).epsilon(1e-6).margin(1e-9));
    CHECK(posterior.epoch_covariance(i, i) == Approx(covariance(m + i, m + i)).epsilon(1e-6));
  }
  const VectorXd sum = posterior.signal + posterior.from_bridge + posterior.from_epochs.rowwise().sum() +
                       posterior.left;
  CHECK((sum - bridge.reading).norm() < 1e-15);
}
