/// @file Loads that nobody stated. Oracle: the density of the readings under a covariance with the load's own
/// in it, and the mean of one part of a sum of Gaussians, both from their definitions (LDLT).

#include "lookup/unknown/unstated_loads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "tests/lookup/unknown/explained_readings.h"
#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t kPlaces = 30;  // a metre apart

/// The intact bridge, on which a load stood when it was read, or at the second of two times.
struct LoadedReadings {
  SyntheticLibrary library{3, 6};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  explicit LoadedReadings(ReadingKind kind) {
    const auto points = static_cast<Index>(library.points.size());
    LoadInfluence& load = sensitivities.load;
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    load.readings = MatrixXd::NullaryExpr(points, kPlaces, [&] { return 1e-8 * normal(random); });
    for (std::size_t i = 0; i < kPlaces; ++i) load.places.push_back(static_cast<double>(i));
    const VectorXd loaded = 30e3 * (load.readings.col(11) + load.readings.col(14));
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, {}};
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      comparison.measured.displacement[i] = library.intact()[i] + loaded[static_cast<Index>(i)];
      comparison.measured.sigma[i] = 2e-5;
      if (kind == ReadingKind::change) comparison.before.push_back(library.intact()[i] + 1e-5);
    }
  }
};

/// What forces at the places of a stretch add, a column each, if they stand there at this time.
MatrixXd columns_of(const UnknownBridge& bridge, const LoadInfluence& load, double from, double to,
                    bool second) {
  MatrixXd columns(bridge.reading.size(), 0);
  for (std::size_t i = 0; i < load.places.size(); ++i) {
    if (load.places[i] < from || load.places[i] > to) continue;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    for (Index k = 0; k < columns.rows(); ++k) {
      const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
      columns(k, columns.cols() - 1) = kUnstatedForce * std::sqrt(1.0 / 0.5) *
                                       (second ? row.after : row.before) *
                                       load.readings(static_cast<Index>(row.channel), static_cast<Index>(i));
    }
  }
  return columns;
}

/// Of what is off in what a load adds to a channel, 8 % of it and 3 % of the root mean square: the same
/// wherever the channel counts.
MatrixXd errors_of(const UnknownBridge& bridge, const VectorXd& added, bool second) {
  const auto weight = [&](Index k) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
    return second ? row.after : row.before;
  };
  double square = 0.0, channels = 0.0;
  for (Index k = 0; k < added.size(); ++k)
    if (weight(k) > 0.0) {
      square += added[k] * added[k];
      channels += 1.0;
    }
  MatrixXd errors = MatrixXd::Zero(added.size(), added.size());
  for (Index k = 0; k < added.size(); ++k)
    for (Index l = 0; l < added.size(); ++l)
      if (bridge.rows[static_cast<std::size_t>(k)].channel ==
          bridge.rows[static_cast<std::size_t>(l)].channel)
        errors(k, l) =
            0.08 * 0.08 * added[k] * added[l] + 0.03 * 0.03 * weight(k) * weight(l) * square / channels;
  return errors;
}

}  // namespace

TEST_CASE("A load on a stretch explains readings as well as its covariance makes them likely") {
  const LoadedReadings readings(GENERATE(ReadingKind::absolute, ReadingKind::change));
  const UnknownSettings settings{GENERATE(Epochs::change, Epochs::both)};
  const Observation observation = observe(readings.comparison, {NoiseShape::gaussian, 0.0}, {});
  const UnknownBridge bridge = unknown_bridge(readings.comparison, observation, settings);
  const auto found = unstated_loads(bridge, intact_gaussians(bridge, observation, kTwoCases), 1000);

  const bool both = bridge.has_first_epoch();
  const std::size_t stretches = 25 + 20;  // of 5 and 10 m on 29 m
  if (is_change(readings.comparison.kind) && !both) REQUIRE(found.size() == stretches);
  CHECK(found.size() >= stretches / 4);
  CHECK(std::ranges::is_sorted(found, std::ranges::greater{},
                               [](const UnstatedLoad& load) { return load.cause.log; }));
  CHECK(found.front().from <= 11.0);
  CHECK(found.front().to >= 14.0);
  CHECK_FALSE(found.front().first_epoch);
  for (const UnstatedLoad& load : found) {
    INFO(load.from << " to " << load.to);
    const bool second = !both || !load.first_epoch;
    const MatrixXd columns = columns_of(bridge, readings.sensitivities.load, load.from, load.to, second);
    const Explained expected = explained_by(bridge, observation, columns);
    const VectorXd mean = columns * expected.amounts;
    CHECK(load.cause.log == Approx(expected.log).epsilon(1e-6));
    CHECK((load.cause.expected - mean).norm() < 1e-6 * mean.norm());
    CHECK(load.force ==
          Approx(kUnstatedForce * std::sqrt(1.0 / 0.5) * std::abs(expected.amounts.sum())).epsilon(1e-6));
    CHECK(load.force > 0.0);
    const MatrixXd errors = errors_of(bridge, load.cause.expected, second);
    CHECK((load.cause.covariance - columns * columns.transpose() - errors).norm() < 1e-6 * errors.norm());
  }
}

TEST_CASE("Without what loads do nothing is said of them") {
  LoadedReadings readings(ReadingKind::absolute);
  readings.sensitivities.load = {};
  const Observation observation = observe(readings.comparison, {NoiseShape::gaussian, 0.0}, {});
  const UnknownBridge bridge = unknown_bridge(readings.comparison, observation, {});
  CHECK(unstated_loads(bridge, intact_gaussians(bridge, observation, kTwoCases), 3).empty());
}
