/// @file Noise shapes, their evidence, and the posterior, against closed forms and brute force in extended
/// precision.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/posterior.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/noise_model.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::all_rows;
using voussoir::test::SyntheticLibrary;

namespace {

constexpr std::array<NoiseShape, 4> kShapes = {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace,
                                               NoiseShape::student};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Densities as textbooks write them, with a standard deviation (uniform: a half-width) of sigma.
long double density(NoiseShape shape, long double error, long double sigma, long double nu) {
  constexpr long double kPi = std::numbers::pi_v<long double>;
  if (shape == NoiseShape::uniform) return std::abs(error) <= sigma ? 0.5L / sigma : 0.0L;
  if (shape == NoiseShape::gaussian)
    return std::exp(-error * error / (2.0L * sigma * sigma)) / std::sqrt(2.0L * kPi * sigma * sigma);
  if (shape == NoiseShape::laplace) {
    const long double b = sigma / std::sqrt(2.0L);
    return std::exp(-std::abs(error) / b) / (2.0L * b);
  }
  const long double s = sigma * std::sqrt((nu - 2.0L) / nu);
  return std::tgamma((nu + 1) / 2) / (std::tgamma(nu / 2) * std::sqrt(nu * kPi) * s) *
         std::pow(1.0L + error * error / (nu * s * s), -(nu + 1) / 2);
}

/// The convolution of the instrument's uniform and the model's Gaussian error, by a fine midpoint rule.
long double convolution(long double error, long double half_width, long double deviation) {
  constexpr int kSteps = 20'000;  // far below the smallest deviation
  long double sum = 0.0L;
  for (int i = 0; i < kSteps; ++i)
    sum +=
        density(NoiseShape::gaussian, error - half_width * (2.0L * (i + 0.5L) / kSteps - 1.0L), deviation, 0);
  return sum / kSteps;
}

/// Standard deviation of the model's own error in a change at a point (database/records/model_error.h).
long double own_error(std::span<const double> prediction, std::span<const double> intact, std::size_t i,
                      const ModelError& error) {
  long double square = 0.0L;
  int count = 0;
  for (std::size_t k = 0; k < prediction.size(); ++k) {
    if (std::isnan(prediction[k])) continue;
    square += std::pow(static_cast<long double>(prediction[k]) - intact[k], 2);
    ++count;
  }
  return std::sqrt(std::pow(error.share * (prediction[i] - intact[i]), 2) +
                   error.common * error.common * square / count);
}

/// p(readings | row) for a stated level, the definition in noise_model.h word for word.
long double likelihood(const Measurements& measured, std::span<const double> prediction,
                       std::span<const double> intact, const NoiseModel& noise, NoiseShape shape,
                       long double level, const ModelError& error = {}) {
  long double product = 1.0L;
  for (std::size_t i = 0; i < prediction.size(); ++i) {
    if (std::isnan(measured.displacement[i])) continue;
    if (std::isnan(prediction[i])) return 0.0L;
    const long double own = measured.sigma[i];
    const long double origin = error == ModelError{} ? 0.0L : intact[i];  // changes count from there
    const long double movement = std::abs(prediction[i] - origin);
    const long double sigma = std::isnan(own) ? level * (movement + 1e-6L) + noise.floor : own;
    const long double model = own_error(prediction, intact, i, error);
    const long double difference = measured.displacement[i] - static_cast<long double>(prediction[i]);
    product *=
        shape == NoiseShape::uniform && model > 0.0L
            ? convolution(difference, sigma, model)
            : density(shape, difference, std::sqrt(sigma * sigma + model * model), noise.degrees_of_freedom);
  }
  return product;
}

/// Mean over log-uniform levels by a fine midpoint rule.
long double over_levels(const Measurements& measured, std::span<const double> prediction,
                        std::span<const double> intact, const NoiseModel& noise, NoiseShape shape,
                        const ModelError& error = {}, int kSteps = 40'000) {
  const long double range = std::log(static_cast<long double>(kLargestLevel) / kSmallestLevel);
  long double sum = 0.0L;
  for (int i = 0; i < kSteps; ++i)
    sum += likelihood(measured, prediction, intact, noise, shape,
                      kSmallestLevel * std::exp(range * (i + 0.5L) / kSteps), error);
  return sum / kSteps;
}

Measurements readings_of(const SyntheticLibrary& library, std::size_t row, double level, std::uint64_t seed) {
  Random random(seed);
  return library.measure(row, level, NoiseShape::uniform, random);
}

}  // namespace

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
          log_evidence_of_rows(library.observe(with_sigma, noise, {}, error), library.table, rows);
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
    const auto logs = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
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
          log_evidence_of_rows(library.observe(measured, noise, {}, error), library.table, rows);
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
          log_evidence_of_rows(library.observe(measured, {shape, level}), library.table, rows)[2]));
    const double automatic = log_evidence_of_rows(library.observe(measured, {NoiseShape::automatic, level}),
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
  const auto with = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
  measured.displacement[0] = std::nan("");
  CHECK(with == log_evidence_of_rows(library.observe(measured, noise), library.table, rows));
  Measurements only = measured;
  for (double& value : only.displacement) value = std::nan("");
  only.displacement[0] = 1e-4;
  CHECK_THROWS_AS(log_evidence_of_rows(library.observe(only, noise), library.table, rows), InputError);
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

TEST_CASE("The posterior is prior times likelihood, normalised by brute force in extended precision") {
  const SyntheticLibrary library(3, 5);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  REQUIRE(eligible.rows.size() == library.table.rows);
  for (const NoiseShape shape : kShapes) {
    const NoiseModel noise{shape, 0.06};
    const Measurements measured = readings_of(library, 7, 0.05, 7);
    const Prior prior{{0, 1, 2}, {1.0, 2.0, 1.0}};
    const auto logs = log_evidence_of_rows(library.observe(measured, noise), library.table, eligible.rows);
    const Posterior result = posterior(library.table, eligible, logs, prior, library.blocks);
    const std::vector<long double> in_class = {1.0L, 15.0L, 105.0L};
    std::vector<long double> weight(library.table.rows);
    long double total = 0.0L;
    for (std::size_t row = 0; row < library.table.rows; ++row) {
      const auto missing = static_cast<std::size_t>(missing_blocks(library.table, row));
      weight[row] = (missing == 1 ? 2.0L : 1.0L) / in_class[missing] *
                    likelihood(measured, library.table.row(row), library.intact(), noise, shape, 0.06L);
      total += weight[row];
    }
    std::vector<long double> block(library.blocks, 0.0L), missing(3, 0.0L);
    for (std::size_t row = 0; row < library.table.rows; ++row) {
      const long double p = weight[row] / total;
      REQUIRE(result.probability[row] == Approx(static_cast<double>(p)).margin(1e-12));
      missing[static_cast<std::size_t>(missing_blocks(library.table, row))] += p;
      for (const BlockId id : library.table.scene(row).removed) block[static_cast<std::size_t>(id)] += p;
    }
    for (std::size_t id = 0; id < library.blocks; ++id)
      REQUIRE(result.block_probability[id] == Approx(static_cast<double>(block[id])).margin(1e-12));
    for (std::size_t i = 0; i < 3; ++i)
      REQUIRE(result.missing_probability[i] == Approx(static_cast<double>(missing[i])).margin(1e-12));
  }
}

TEST_CASE("The credible set is the shortest list of likeliest rows that holds 95 % of the probability") {
  const SyntheticLibrary library(3, 5);
  const Eligible eligible = eligible_rows(library.table, {1});
  const Measurements measured = readings_of(library, 7, 0.2, 8);
  const auto logs = log_evidence_of_rows(library.observe(measured, {NoiseShape::gaussian, 0.3}),
                                         library.table, eligible.rows);
  const Posterior result = posterior(library.table, eligible, logs, {{1}, {}}, library.blocks);
  REQUIRE(result.credible.size() > 2);
  double share = 0.0;
  for (std::size_t i = 0; i < result.credible.size(); ++i) {
    CHECK(share < kCredibleShare);
    share += result.probability[result.credible[i]];
    if (i > 0) CHECK(result.probability[result.credible[i]] <= result.probability[result.credible[i - 1]]);
  }
  CHECK(share >= kCredibleShare);
}

TEST_CASE(
    "Unresolved rows take no part and are counted, and so do rows with other numbers of missing blocks") {
  SyntheticLibrary library(3, 5);
  library.outcome[4] = static_cast<std::uint8_t>(Outcome::unresolved);
  const Eligible eligible = eligible_rows(library.table, {1});
  CHECK(eligible.unresolved == 1);
  CHECK(eligible.rows.size() == 14);
  const Measurements measured = readings_of(library, 4, 0.0, 9);
  const auto logs = log_evidence_of_rows(library.observe(measured, {NoiseShape::gaussian, 0.1}),
                                         library.table, eligible.rows);
  const Posterior result = posterior(library.table, eligible, logs, {{1}, {}}, library.blocks);
  CHECK(result.probability[4] == 0.0);
  CHECK(result.probability[0] == 0.0);
  CHECK(std::accumulate(result.probability.begin(), result.probability.end(), 0.0) == Approx(1.0));
}

TEST_CASE("If every scene is impossible there is no probability at all") {
  const SyntheticLibrary library(2, 3);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  Measurements measured = readings_of(library, 2, 0.0, 10);
  measured.displacement[3] *= 50.0;
  const auto logs = log_evidence_of_rows(library.observe(measured, {NoiseShape::uniform, 0.05}),
                                         library.table, eligible.rows);
  const Posterior result = posterior(library.table, eligible, logs, {}, library.blocks);
  CHECK(result.credible.empty());
  CHECK(*std::max_element(result.probability.begin(), result.probability.end()) == 0.0);
}

TEST_CASE("A prior needs a weight for each number of missing blocks") {
  const SyntheticLibrary library(2, 3);
  const Eligible eligible = eligible_rows(library.table, {0, 1});
  CHECK_THROWS_AS(
      posterior(library.table, eligible, std::vector<double>(library.table.rows, 0.0), {{0, 1}, {1.0}}, 6),
      InputError);
  for (const Prior& nothing_possible : {Prior{{0, 1}, {0.0, 0.0}}, Prior{{0, 2}, {0.0, 1.0}}})
    CHECK_THROWS_WITH(log_prior_by_missing(library.table, eligible, nothing_possible),
                      Catch::Contains("leave no scene of the database possible, expected a positive weight"));
  CHECK(log_prior_by_missing(library.table, eligible, {{0, 1}, {0.0, 1.0}})[1] ==
        Approx(std::log(1.0 / 6.0)));
}

TEST_CASE(
    "A silent sensor counts with its chance of failing where its block stands, and costs nothing where it is "
    "gone") {
  const SyntheticLibrary library(2, 4);
  Measurements measured = readings_of(library, 0, 0.02, 11);
  const auto rows = all_rows(library.table);
  const NoiseModel noise{NoiseShape::gaussian, 0.05};
  for (const std::size_t point : {std::size_t{2}, std::size_t{3}})  // both sensors of the second top block
    measured.displacement[point] = std::nan("");
  const auto unlisted = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
  for (const std::size_t point : {std::size_t{2}, std::size_t{3}}) measured.silent[point] = true;
  const auto silent = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
  const BlockId block = library.points[2].block;
  int standing = 0, gone = 0;
  for (const std::size_t row : rows) {
    const bool lacks = library.table.scene(row).lacks(block);
    REQUIRE((silent[row] == -kInfinity) == (unlisted[row] == -kInfinity));
    if (unlisted[row] == -kInfinity) continue;
    ++(lacks ? gone : standing);
    CHECK(silent[row] - unlisted[row] == Approx(lacks ? 0.0 : 2.0 * std::log(noise.silence)).margin(1e-9));
  }
  CHECK(standing > 3);
  CHECK(gone > 3);
}
