/// @file Noise shapes and their evidence, against closed forms and brute force in extended precision.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/noise_model.h"
#include "tests/lookup/evidence/textbook_likelihood.h"

using namespace voussoir;
using namespace voussoir::test;

TEST_CASE("Log densities are the logarithms of the textbook densities") {
  for (const NoiseShape shape : kShapes)
    for (const double z : {0.0, 0.3, -0.99, 0.99})
      CHECK(log_density(shape, z, 5.0) ==
            Approx(static_cast<double>(std::log(density(shape, z, 1.0L, 5.0L)))));
  CHECK(log_density(NoiseShape::uniform, 1.01, 5.0) == -kInfinity);
  CHECK(log_density(NoiseShape::gaussian, 6.0, 0.0) == Approx(-18.0 - 0.5 * std::log(2 * std::numbers::pi)));
}

TEST_CASE("Densities integrate to one and have the standard deviation that they claim") {
  for (const NoiseShape shape : kShapes) {
    double mass = 0.0, square = 0.0;
    constexpr double kStep = 0.01;
    for (double z = -400.0 + kStep / 2; z < 400.0; z += kStep) {
      const double p = std::exp(log_density(shape, z, 5.0));
      mass += p * kStep;
      square += z * z * p * kStep;
    }
    INFO(to_string(shape));
    CHECK(mass == Approx(1.0).epsilon(1e-4));
    CHECK(std::sqrt(square) == Approx(standard_deviation(shape)).epsilon(1e-3));
  }
}

TEST_CASE("Noise levels are shares or percentages, and anything else is refused") {
  CHECK(parse_noise_level("5%") == Approx(0.05));
  CHECK(parse_noise_level("0.05") == Approx(0.05));
  CHECK(parse_noise_level("0") == 0.0);
  CHECK(parse_chance("10%") == Approx(0.1));
  CHECK_THROWS_WITH(parse_chance("150%"), "'150%' is no chance, expected 0 to 100 %, such as 10% or 0.1");
  for (const std::string text : {"", "%", "five", "-1%", "5 %x", "200%", "nan", "inf"})
    CHECK_THROWS_AS(parse_noise_level(text), InputError);
  CHECK_THROWS_WITH(parse_noise_level("5"),
                    "'5' is no noise level, expected a share of the displacement such as 5% or 0.05");
  CHECK(parse_noise_shape("laplace") == NoiseShape::laplace);
  CHECK_THROWS_AS(parse_noise_shape("normal"), InputError);
}

TEST_CASE("The likelihood for a stated level is the product of the textbook densities") {
  const SyntheticLibrary library(2, 4);
  const Measurements measured = readings_of(library, 3, 0.05, 1);
  const auto rows = all_rows(library.table);
  for (const NoiseShape shape : kShapes) {
    for (const bool everything : {false, true}) {
      NoiseModel noise{shape, 0.3, 0.0, 5.0};
      Measurements with_sigma = measured;
      ModelError error;
      if (everything) {
        noise.floor = 2e-5;
        error = {0.1, 0.05, {}};
        with_sigma.sigma[1] = 3e-4;
      }
      const auto logs =
          log_evidence_of_each(library.observe(with_sigma, noise, {}, error), library.table, rows);
      int possible = 0, impossible = 0;
      for (const std::size_t row : rows) {
        const long double exact =
            likelihood(with_sigma, library.table.row(row), library.intact(), noise, shape, 0.3L, error);
        if (!everything) REQUIRE((logs[row] == -kInfinity) == (exact == 0.0L));
        if (exact == 0.0L) CHECK(logs[row] < -5000.0);  // no scene, or what extended precision cannot hold
        ++(exact == 0.0L ? impossible : possible);
        // The convolution is good to 1e-5 a reading (bounded_errors.h), and there are 8 readings.
        const bool convolved = everything && shape == NoiseShape::uniform;
        if (exact > 0.0L)
          REQUIRE(logs[row] == Approx(static_cast<double>(std::log(exact)))
                                   .epsilon(convolved ? 1e-6 : 1e-10)
                                   .margin(convolved ? 8e-5 : 0.0));
      }
      INFO(to_string(shape));
      CHECK(possible > 3);
      CHECK(impossible > 3);  // lack a block with a reading, or without model error lie beyond the bound
    }
  }
}

TEST_CASE("The evidence over all levels is the brute-force mean over a fine grid of levels") {
  const SyntheticLibrary library(2, 3);
  const Measurements measured = readings_of(library, 1, 0.05, 2);
  const auto rows = all_rows(library.table);
  for (const NoiseShape shape : {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace}) {
    const NoiseModel noise{shape, std::nullopt};
    const auto logs = log_evidence_of_each(library.observe(measured, noise), library.table, rows);
    std::vector<long double> exact;
    for (const std::size_t row : rows)
      exact.push_back(over_levels(measured, library.table.row(row), library.intact(), noise, shape));
    const long double negligible = *std::max_element(exact.begin(), exact.end()) * std::exp(-50.0L);
    int compared = 0, left_out = 0;
    for (const std::size_t row : rows) {
      INFO(to_string(shape) << " row " << row);
      ++(logs[row] == -kInfinity ? left_out : compared);
      // The midpoint rule cuts the uniform shape's edge within one of its 40,000 steps.
      if (logs[row] == -kInfinity)
        CHECK(exact[row] <= negligible);
      else
        CHECK(logs[row] == Approx(static_cast<double>(std::log(exact[row])))
                               .margin(shape == NoiseShape::uniform ? 5e-3 : 1e-6));
    }
    CHECK(compared > 3);
    CHECK(left_out > 3);
  }
}

TEST_CASE(
    "Where absolute errors or the model's stand beside an unknown level, brute force over levels agrees") {
  const SyntheticLibrary library(2, 3);
  const Measurements measured = readings_of(library, 2, 0.05, 3);
  const auto rows = all_rows(library.table);
  for (const ModelError& error : {ModelError{}, ModelError{0.05, 0.02, {}}, ModelError{0.3, 0.3, {}}})
    for (const NoiseShape shape : kShapes) {
      const NoiseModel noise{shape, std::nullopt, 1e-5, 5.0};
      const auto logs =
          log_evidence_of_each(library.observe(measured, noise, {}, error), library.table, rows);
      const double best = *std::max_element(logs.begin(), logs.end());
      int compared = 0;
      for (const std::size_t row : rows) {
        if (logs[row] < best - 30.0) continue;
        ++compared;
        const long double exact =
            over_levels(measured, library.table.row(row), library.intact(), noise, shape, error, 2'000);
        INFO(to_string(shape) << " row " << row << " model error " << error.share);
        // A percent of a probability: the midpoint rule's own error at the uniform shape's edge.
        CHECK(logs[row] == Approx(static_cast<double>(std::log(exact))).margin(0.01));
      }
      CHECK(compared > 2);
    }
}

TEST_CASE("The automatic shape is the mean of uniform, Gaussian and Laplace") {
  const SyntheticLibrary library(2, 3);
  const Measurements measured = readings_of(library, 2, 0.05, 4);
  const auto rows = all_rows(library.table);
  for (const std::optional<double> level : {std::optional<double>(), std::optional<double>(0.1)}) {
    long double sum = 0.0L;
    for (const NoiseShape shape : {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace})
      sum += std::exp(static_cast<long double>(
          log_evidence_of_each(library.observe(measured, {shape, level}), library.table, rows)[2]));
    const double automatic = log_evidence_of_each(library.observe(measured, {NoiseShape::automatic, level}),
                                                  library.table, rows)[2];
    CHECK(automatic == Approx(static_cast<double>(std::log(sum / 3.0L))).epsilon(1e-12));
  }
}

TEST_CASE("Points that no scene moves are left out, and readings only there are refused") {
  SyntheticLibrary library(2, 3);
  for (std::size_t row = 0; row < library.table.rows; ++row)
    library.vertical[row * library.table.points] = 0.0;
  Measurements measured = readings_of(library, 2, 0.05, 5);
  const NoiseModel noise{NoiseShape::gaussian, 0.05};
  const auto rows = all_rows(library.table);
  measured.displacement[0] = 1e-4;
  const auto with = log_evidence_of_each(library.observe(measured, noise), library.table, rows);
  measured.displacement[0] = std::nan("");
  CHECK(with == log_evidence_of_each(library.observe(measured, noise), library.table, rows));
  Measurements only = measured;
  for (double& value : only.displacement) value = std::nan("");
  only.displacement[0] = 1e-4;
  CHECK_THROWS_AS(log_evidence_of_each(library.observe(only, noise), library.table, rows), InputError);
}

TEST_CASE("The estimated level of a scene is that of the noise that made its readings") {
  const SyntheticLibrary library(3, 12);
  Random random(6);
  const Measurements uniform = library.measure(5, 0.08, NoiseShape::uniform, random);
  const NoiseEstimate bound =
      estimate_noise(library.observe(uniform, {NoiseShape::uniform, {}}), library.table.row(5));
  CHECK(bound.estimated);
  CHECK(bound.level == Approx(0.08).epsilon(0.15));
  const Measurements gaussian = library.measure(5, 0.08, NoiseShape::gaussian, random);
  const NoiseEstimate sigma =
      estimate_noise(library.observe(gaussian, {NoiseShape::gaussian, {}}), library.table.row(5));
  CHECK(sigma.level == Approx(0.08).epsilon(0.5));
  CHECK_FALSE(
      estimate_noise(library.observe(gaussian, {NoiseShape::gaussian, 0.1}), library.table.row(5)).estimated);
}

TEST_CASE("A reading at a point that is held says that its block is there, and no more") {
  SyntheticLibrary library(3, 6);
  for (std::size_t row = 0; row < library.table.rows; ++row)
    if (double& held = library.vertical[row * library.points.size()]; !std::isnan(held)) held = 0.0;
  Measurements measured = as_measurements(library.intact());
  const NoiseModel noise{NoiseShape::gaussian, 0.05};
  const auto rows = all_rows(library.table);
  const auto read = log_chance_of_silence(library.observe(measured, noise), library.table, rows);
  measured.displacement[0] = std::nan("");
  const auto unread = log_chance_of_silence(library.observe(measured, noise), library.table, rows);
  std::size_t excluded = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    CHECK(unread[row] == 0.0);
    const bool is_there = !std::isnan(library.table.row(row)[0]);
    CHECK(read[row] == (is_there ? 0.0 : kImpossible));
    excluded += is_there ? 0 : 1;
  }
  CHECK(excluded > 10);
}
