/// @file Oracle: chances by dense inverses and determinants of the covariances of each set of sensors, all
/// that leave one out compared; how near they are by drawn readings (detectability.h).

#include "lookup/plan/sensor_choice.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "lookup/plan/loss_gaussian.h"
#include "tests/lookup/plan/planned_bridge.h"

using namespace voussoir;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::PlannedBridge;

namespace {

/// Intact is a thousand times as likely beforehand as any loss, silence has a chance of one in ten.
SightSettings settings_for(double certain) {
  return {.log_prior_intact = std::log(0.999),
          .log_prior_loss = std::log(0.001),
          .log_silence = std::log(0.1),
          .certain = certain};
}

/// The loss's Gaussian, nowhere narrower than the intact bridge's.
LossGaussian wider_than(const MatrixXd& intact, LossGaussian loss) {
  const std::vector<Index> read = rows_with_reading(loss.signal);
  const MatrixXd covariance = intact(read, read);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(loss.covariance(read, read) - covariance,
                                                                  covariance);
  const MatrixXd columns = covariance * solver.eigenvectors();
  loss.covariance(read, read) =
      covariance + columns * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * columns.transpose();
  return loss;
}

double sum_of_chances(const PlannedBridge& planned, const std::vector<Index>& rows,
                      const SightSettings& settings) {
  const MatrixXd intact = loss_gaussian(planned.bridge, planned.noise, std::nullopt).covariance;
  double sum = 0.0;
  for (const BlockId block : blocks_with_sensitivities(planned.bridge)) {
    const LossGaussian loss = wider_than(intact, loss_gaussian(planned.bridge, planned.noise, block));
    std::vector<Index> read;
    std::ranges::copy_if(rows, std::back_inserter(read),
                         [&](Index row) { return !std::isnan(loss.signal[row]); });
    const auto silent = static_cast<double>(rows.size() - read.size());
    const double wanted = std::log(settings.certain / (1.0 - settings.certain)) + settings.log_prior_intact -
                          settings.log_prior_loss - planned.bridge.loss_of(block).log_weight +
                          silent * settings.log_silence;
    double divergence = 0.0;
    if (!read.empty()) {
      const VectorXd signal = loss.signal(read);
      const MatrixXd inverse = MatrixXd(intact(read, read)).inverse();
      const MatrixXd ratio = inverse * loss.covariance(read, read);
      divergence = 0.5 * (signal.dot(inverse * signal) + ratio.trace() - static_cast<double>(read.size()) -
                          std::log(ratio.determinant()));
    }
    sum += wanted <= 0.0 ? 1.0 : divergence <= 0.0 ? 0.0 : std::exp(-wanted / divergence);
  }
  return sum;
}

}  // namespace

TEST_CASE("The sensor is left out whose absence costs the fewest sights (dense inverses)", "[plan]") {
  const double sigma = GENERATE(5e-6, 2e-5, 1e-4), certain = GENERATE(0.5, 0.9);
  const SightSettings settings = settings_for(certain);
  const PlannedBridge planned(sigma);
  std::vector<Index> left = rows_that_help(planned.bridge, planned.noise, settings, 100);
  REQUIRE(left.size() == 8);
  while (left.size() > 1) {
    const Index last = left.back();
    left.pop_back();
    const double kept = sum_of_chances(planned, left, settings);
    for (const Index other : left) {
      std::vector<Index> instead = left;
      *std::ranges::find(instead, other) = last;
      CHECK(sum_of_chances(planned, instead, settings) <= kept * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("Fewer sensors are the first of more", "[plan]") {
  const PlannedBridge planned(2e-5);
  const SightSettings settings = settings_for(0.9);
  const std::vector<Index> all = rows_that_help(planned.bridge, planned.noise, settings, 100);
  std::vector<Index> sorted = all;
  std::ranges::sort(sorted);
  CHECK(sorted == std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(rows_that_help(planned.bridge, planned.noise, settings, 3) ==
        std::vector<Index>(all.begin(), all.begin() + 3));
}

TEST_CASE("As many losses are seen as their chances sum up to (drawn readings)", "[plan]") {
  const double sigma = GENERATE(5e-6, 2e-5, 1e-4);
  const SightSettings settings = settings_for(0.9);
  const PlannedBridge planned(sigma);
  const std::vector<Sight> sights = sights_of(planned.bridge, planned.noise, settings);
  double seen = 0.0;
  for (const Sight& sight : sights) seen += sight.seen;
  const std::vector<Index> all = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto count = static_cast<double>(sights.size());
  CHECK(sum_of_chances(planned, all, settings) / count == Approx(seen / count).margin(0.1));
}
