/// @file Nuisances marginalised in closed form, against the dense multivariate Gaussian that they stand for.

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/nuisance.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::all_rows;
using voussoir::test::SyntheticLibrary;

namespace {

constexpr double kFloor = 1e-5;  // [m] keeps the dense covariance well conditioned

/// Readings of the first half of the points belong to one levelling, the others to another.
Comparison two_levellings(const SyntheticLibrary& library, const Measurements& measured) {
  Comparison comparison = absolute_readings(library.library(), measured);
  comparison.kind = ReadingKind::change;
  for (std::size_t i = 0; i < library.points.size(); ++i)
    comparison.levelling.push_back(i < library.points.size() / 2 ? 0 : 7);
  return comparison;
}

/// log N(y; 0, diag(sigma^2 + model's variance) + sum of prior variances times outer products), by Cholesky.
double dense_log_likelihood(const Comparison& comparison, std::size_t row, double level,
                            const Nuisance& nuisance) {
  const auto prediction = comparison.library.table.row(row);
  const auto intact = comparison.library.table.row(0);
  const auto n = static_cast<Eigen::Index>(prediction.size());
  Eigen::VectorXd d(n), y(n), x(n), signal(n), origin(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    d[i] = prediction[k];
    y[i] = comparison.measured.displacement[k] - d[i];
    x[i] = comparison.library.points[k].position.x();
    signal[i] = d[i] - intact[k];
    origin[i] = is_change(comparison.kind) ? intact[k] : 0.0;
  }
  const Eigen::VectorXd sigma = level * ((d - origin).cwiseAbs().array() + 1e-6) + kFloor;
  const ModelError& error = comparison.model_error;
  Eigen::MatrixXd covariance = (sigma.array().square() + error.share * error.share * signal.array().square() +
                                error.common * error.common * signal.squaredNorm() / static_cast<double>(n))
                                   .matrix()
                                   .asDiagonal();
  const bool imprecise = !is_change(comparison.kind) && error != ModelError{};
  const double scale = std::max(nuisance.scale, imprecise ? kLeastUnknownScale : 0.0);
  covariance += scale * scale * (d - origin) * (d - origin).transpose();
  const double epochs = is_change(comparison.kind) ? 2.0 : 1.0;
  for (const int levelling : {0, 7}) {
    Eigen::VectorXd in = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
      in[i] = comparison.levelling.empty() ? levelling == 0
                                           : comparison.levelling[static_cast<std::size_t>(i)] == levelling;
    if (in.sum() == 0.0) continue;
    const Eigen::VectorXd tilt = in.array() * (x.array() - x.dot(in) / in.sum());
    covariance += epochs * nuisance.datum * nuisance.datum * in * in.transpose();
    covariance += epochs * nuisance.tilt * nuisance.tilt * tilt * tilt.transpose();
  }
  const Eigen::LLT<Eigen::MatrixXd> factorised(covariance);
  const double log_determinant = 2.0 * factorised.matrixL().toDenseMatrix().diagonal().array().log().sum();
  return -0.5 * (static_cast<double>(n) * std::log(2.0 * std::numbers::pi) + log_determinant +
                 y.dot(factorised.solve(y)));
}

std::vector<double> evidence(const Comparison& comparison, const NoiseModel& noise,
                             const Nuisance& nuisance) {
  return log_evidence_of_each(observe(comparison, noise, nuisance), comparison.library.table,
                              all_rows(comparison.library.table));
}

const std::array<Nuisance, 4> kNuisances = {Nuisance{0.2, 0.0, 0.0}, Nuisance{0.0, 1e-3, 0.0},
                                            Nuisance{0.0, 0.0, 1e-4}, Nuisance{0.2, 1e-3, 1e-4}};

}  // namespace

TEST_CASE("Marginalised scale, datum and tilt of every levelling give the dense Gaussian's likelihood") {
  const SyntheticLibrary library(3, 5);
  Random random(1);
  const Measurements measured = library.measure(0, 0.05, NoiseShape::gaussian, random);
  const std::array<Comparison, 2> kinds = {absolute_readings(library.library(), measured),
                                           two_levellings(library, measured)};
  for (Comparison comparison : kinds)
    for (const ModelError& error : {ModelError{}, ModelError{0.1, 0.2, {}}})
      for (const Nuisance& nuisance : kNuisances) {
        comparison.model_error = error;
        const auto logs = evidence(comparison, {NoiseShape::gaussian, 0.05, kFloor}, nuisance);
        for (const std::size_t row : {std::size_t{0}, std::size_t{3}, std::size_t{20}})
          CHECK(logs[row] == Approx(dense_log_likelihood(comparison, row, 0.05, nuisance)).epsilon(1e-9));
      }
}

TEST_CASE("Nuisances at an unknown level: the mean of dense Gaussians over a fine grid of levels") {
  const SyntheticLibrary library(3, 5);
  Random random(2);
  Comparison comparison = two_levellings(library, library.measure(4, 0.05, NoiseShape::gaussian, random));
  comparison.model_error = {0.05, 0.05, {}};
  const Nuisance nuisance = {0.0, 1e-4, 1e-5};
  const auto logs = evidence(comparison, {NoiseShape::gaussian, std::nullopt, kFloor}, nuisance);
  const double best = *std::max_element(logs.begin(), logs.end());
  constexpr int kSteps = 4000;
  const double range = std::log(kLargestLevel / kSmallestLevel);
  int compared = 0;
  for (std::size_t row = 0; row < logs.size(); ++row) {
    if (logs[row] < best - 5.0) continue;
    double sum = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kSteps; ++i)
      sum =
          log_sum(sum, dense_log_likelihood(comparison, row,
                                            kSmallestLevel * std::exp(range * (i + 0.5) / kSteps), nuisance));
    CHECK(logs[row] == Approx(sum - std::log(kSteps)).margin(1e-3));  // the grid's rule: 1e-7 of a bell
    ++compared;
  }
  CHECK(compared > 2);
}

TEST_CASE("A shifted, tilted and scaled levelling is seen through") {
  const SyntheticLibrary library(4, 9);
  Random random(3);
  const std::size_t truth = library.row_of({{BlockId{22}}});
  Measurements measured = library.measure(truth, 0.002, NoiseShape::gaussian, random);
  for (std::size_t i = 0; i < measured.displacement.size(); ++i)
    measured.displacement[i] = 1.1 * measured.displacement[i] + 5e-4 + 2e-5 * library.points[i].position.x();
  const auto rows = eligible_rows(library.table, {0, 1}).rows;
  const NoiseModel noise{NoiseShape::gaussian, 0.002};
  const auto naive = log_evidence_of_each(library.observe(measured, noise), library.table, rows);
  const auto with =
      log_evidence_of_each(library.observe(measured, noise, {0.2, 1e-3, 1e-4}), library.table, rows);
  const auto best = [&](const std::vector<double>& logs) {
    return static_cast<std::size_t>(std::max_element(logs.begin(), logs.end()) - logs.begin());
  };
  CHECK(best(with) == truth);
  CHECK(with[truth] > naive[truth]);
}

TEST_CASE(
    "An unknown common factor alone gives the dense Gaussian's likelihood, too, and other shapes come near") {
  const SyntheticLibrary library(3, 5);
  Random random(5);
  const Measurements measured = library.measure(4, 0.05, NoiseShape::gaussian, random);
  const Comparison comparison = absolute_readings(library.library(), measured);
  const auto rows = all_rows(library.table);
  const Nuisance nuisance = {0.02, 0.0, 0.0};
  const NoiseModel noise{NoiseShape::gaussian, 0.05, kFloor};
  const auto logs = log_evidence_of_each(observe(comparison, noise, nuisance), library.table, rows);
  for (const std::size_t row : {std::size_t{0}, std::size_t{3}, std::size_t{20}})
    CHECK(logs[row] == Approx(dense_log_likelihood(comparison, row, 0.05, nuisance)).epsilon(1e-9));
  // Student's t of many degrees of freedom is the Gaussian: to 1 / nu of the squares.
  const NoiseModel student{NoiseShape::student, 0.05, kFloor, 1e6};
  const auto nearly = log_evidence_of_each(observe(comparison, student, nuisance), library.table, rows);
  CHECK(nearly[3] == Approx(logs[3]).margin(1e-3));
}

TEST_CASE(
    "Bounded and Laplace readings that are all 3 % too large are still of their scene if the factor is "
    "open") {
  const SyntheticLibrary library(4, 9);
  Random random(6);
  const std::size_t truth = library.row_of({{BlockId{22}}});
  for (const NoiseShape shape : {NoiseShape::uniform, NoiseShape::laplace}) {
    Measurements measured = library.measure(truth, 0.003, shape, random);
    for (double& value : measured.displacement) value *= 1.03;
    const NoiseModel noise{shape, 0.003};
    const auto rows = eligible_rows(library.table, {0, 1}).rows;
    const auto open = log_evidence_of_each(library.observe(measured, noise, {0.02}), library.table, rows);
    const auto closed = log_evidence_of_each(library.observe(measured, noise), library.table, rows);
    CHECK(static_cast<std::size_t>(std::max_element(open.begin(), open.end()) - open.begin()) == truth);
    CHECK(open[truth] > closed[truth] + 10.0);
  }
}

TEST_CASE("A datum or tilt is refused beside noise that is not Gaussian") {
  const SyntheticLibrary library(2, 3);
  Random random(4);
  const Measurements measured = library.measure(0, 0.05, NoiseShape::gaussian, random);
  CHECK_THROWS_AS(library.observe(measured, {NoiseShape::laplace, 0.05}, {0.0, 1e-3}), InputError);
  CHECK_NOTHROW(library.observe(measured, {NoiseShape::gaussian, std::nullopt, 1e-5}, {0.2, 1e-3}));
}
