/// @file Nuisances marginalised in closed form, against the dense multivariate Gaussian that they stand for.

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/nuisance.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::all_rows;
using voussoir::test::SyntheticLibrary;

namespace {

/// log N(y; 0, diag(sigma^2) + sum of prior variances times outer products), by Cholesky.
double dense_log_likelihood(const SyntheticLibrary& library, const Measurements& measured, std::size_t row,
                            double level, const Nuisance& nuisance) {
  const auto prediction = library.table.row(row);
  const auto n = static_cast<Eigen::Index>(prediction.size());
  Eigen::VectorXd d(n), y(n), x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    d[i] = prediction[static_cast<std::size_t>(i)];
    y[i] = measured.displacement[static_cast<std::size_t>(i)] - d[i];
    x[i] = library.points[static_cast<std::size_t>(i)].position.x();
  }
  const double factor = nuisance.scale > 0.0 ? (d + y).dot(d) / d.squaredNorm() : 1.0;
  const Eigen::VectorXd sigma = level * (factor * d.cwiseAbs().array() + 1e-6);
  const Eigen::VectorXd tilt = x.array() - x.mean();
  Eigen::MatrixXd covariance = sigma.array().square().matrix().asDiagonal();
  covariance += nuisance.scale * nuisance.scale * d * d.transpose();
  covariance += nuisance.datum * nuisance.datum * Eigen::MatrixXd::Ones(n, n);
  covariance += nuisance.tilt * nuisance.tilt * tilt * tilt.transpose();
  const Eigen::LLT<Eigen::MatrixXd> factorised(covariance);
  const double log_determinant = 2.0 * factorised.matrixL().toDenseMatrix().diagonal().array().log().sum();
  return -0.5 * (static_cast<double>(n) * std::log(2.0 * std::numbers::pi) + log_determinant +
                 y.dot(factorised.solve(y)));
}

}  // namespace

TEST_CASE("Marginalised scale, datum and tilt give the dense Gaussian's likelihood") {
  const SyntheticLibrary library(3, 5);
  Random random(1);
  const Measurements measured = library.measure(0, 0.05, NoiseShape::gaussian, random);
  for (const Nuisance nuisance : {Nuisance{0.2, 0.0, 0.0}, Nuisance{0.0, 1e-3, 0.0}, Nuisance{0.0, 0.0, 1e-4},
                                  Nuisance{0.2, 1e-3, 1e-4}}) {
    const auto logs =
        log_evidence_with_nuisance(library.observe(measured, {NoiseShape::gaussian, 0.05}), library.table,
                                   all_rows(library.table), library.points, nuisance);
    for (const std::size_t row : {std::size_t{0}, std::size_t{3}, std::size_t{20}})
      CHECK(logs[row] == Approx(dense_log_likelihood(library, measured, row, 0.05, nuisance)).epsilon(1e-9));
  }
}

TEST_CASE(
    "Without nuisances the evidence is that of plain Gaussian noise, at a stated and at an unknown level") {
  const SyntheticLibrary library(3, 5);
  Random random(2);
  const Measurements measured = library.measure(4, 0.05, NoiseShape::gaussian, random);
  const auto rows = all_rows(library.table);
  for (const std::optional<double> level : {std::optional<double>(0.05), std::optional<double>()}) {
    const NoiseModel noise{NoiseShape::gaussian, level};
    const auto plain = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
    const auto with = log_evidence_with_nuisance(library.observe(measured, noise), library.table, rows,
                                                 library.points, {0.0, 1e-15, 1e-15});
    const double negligible = *std::max_element(with.begin(), with.end()) - 50.0;
    int compared = 0, left_out = 0;
    for (const std::size_t row : rows) {
      const bool possible = plain[row] != -std::numeric_limits<double>::infinity();
      ++(possible ? compared : left_out);
      if (possible)
        CHECK(with[row] == Approx(plain[row]).epsilon(1e-6));
      else
        CHECK(with[row] < negligible);
    }
    CHECK(compared > 3);
    CHECK(left_out > 3);
  }
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
  const auto naive = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
  const auto with = log_evidence_with_nuisance(library.observe(measured, noise), library.table, rows,
                                               library.points, {0.2, 1e-3, 1e-4});
  const auto best = [&](const std::vector<double>& logs) {
    return static_cast<std::size_t>(std::max_element(logs.begin(), logs.end()) - logs.begin());
  };
  CHECK(best(with) == truth);
  CHECK(with[truth] > naive[truth]);
}

TEST_CASE(
    "Nuisances are refused beside noise that is not Gaussian, or of unknown level beside absolute errors") {
  const SyntheticLibrary library(2, 3);
  Random random(4);
  const Measurements measured = library.measure(0, 0.05, NoiseShape::gaussian, random);
  const auto rows = all_rows(library.table);
  CHECK_THROWS_AS(log_evidence_with_nuisance(library.observe(measured, {NoiseShape::laplace, 0.05}),
                                             library.table, rows, library.points, {0.2}),
                  InputError);
  CHECK_THROWS_AS(
      log_evidence_with_nuisance(library.observe(measured, {NoiseShape::gaussian, std::nullopt, 1e-5}),
                                 library.table, rows, library.points, {0.2}),
      InputError);
}
