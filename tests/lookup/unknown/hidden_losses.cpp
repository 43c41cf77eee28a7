/// @file Losses that only readings of the lost block exclude. Oracle: the rows of those readings taken out of
/// the intact bridge's covariance, and the density of what is left at the best of many sizes of the loss.

#include "lookup/unknown/hidden_losses.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "lookup/evidence/scene_evidence.h"
#include "tests/lookup/unknown/explained_readings.h"
#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Readings of what shows without a block, but for the points on another one.
struct KeptReadings {
  SyntheticLibrary library{3, 4};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  Eligible eligible = eligible_rows(library.table, {0, 1});

  explicit KeptReadings(ReadingKind kind) {
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, {}};
    const std::span<const double> lost = library.table.row(library.row_of({{BlockId{6}}}));
    for (std::size_t i = 0; i < lost.size(); ++i) {
      comparison.measured.displacement[i] = lost[i] + 4e-5 * std::sin(static_cast<double>(7 * i));
      comparison.measured.sigma[i] = 2e-5;
      if (kind == ReadingKind::change) comparison.before.push_back(library.intact()[i] + 1e-5);
    }
  }
};

/// log density of the rows that a scene has values in, at most over sizes from none to `most` times its
/// signal: in large steps, then (it is concave) in small ones about the best.
double largest_density(const UnknownBridge& bridge, const CaseNoise& noise, const std::vector<Index>& kept,
                       const VectorXd& signal, double most) {
  const MatrixXd covariance = intact_covariance_of(bridge, noise);
  double best = kImpossible, best_size = 0.0;
  const auto look = [&](double from, double to, double step) {
    for (double size = std::max(0.0, from); size <= std::min(most, to); size += step) {
      const VectorXd left = (bridge.reading - size * signal)(kept);
      const double log = log_normal(left, MatrixXd(covariance(kept, kept)));
      if (log > best) best = log, best_size = size;
    }
  };
  look(0.0, most, 0.05);
  look(best_size - 0.05, best_size + 0.05, 1e-3);
  return best;
}

/// HiddenLoss::gain of a row, from the definition.
double gain_of(const UnknownBridge& bridge, const Observation& observation,
               std::span<const double> prediction) {
  std::vector<Index> kept;
  VectorXd signal = VectorXd::Zero(bridge.reading.size());
  for (Index k = 0; k < signal.size(); ++k) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
    if (std::isnan(prediction[row.channel])) continue;
    kept.push_back(k);
    signal[k] = row.after * (prediction[row.channel] - observation.intact[row.channel]);
  }
  double with = kImpossible, without = kImpossible;
  for (const UnknownCase& one : kTwoCases) {
    const CaseNoise noise = case_noise(bridge, observation, one);
    with = std::max(with, largest_density(bridge, noise, kept, signal, 10.0));
    without = std::max(without, largest_density(bridge, noise, kept, signal, 0.0));
  }
  return with - without;
}

}  // namespace

TEST_CASE("A hidden loss gains what it makes of the density of all other readings") {
  const KeptReadings readings(GENERATE(ReadingKind::absolute, ReadingKind::change));
  const UnknownSettings settings{GENERATE(Epochs::change, Epochs::both)};
  const SceneTable& table = readings.library.table;
  const Observation observation = observe(readings.comparison, {NoiseShape::gaussian, 0.0}, {});
  const UnknownBridge bridge = unknown_bridge(readings.comparison, observation, settings);
  const auto found = hidden_losses(bridge, observation, readings.comparison.library, readings.eligible,
                                   intact_gaussians(bridge, observation, kTwoCases));

  REQUIRE(found.size() == 4);  // the blocks of the highest course, each of which has two points
  CHECK(std::ranges::is_sorted(found, std::ranges::greater{}, &HiddenLoss::gain));
  CHECK(found.front().gain > found.back().gain + 1.0);
  for (const HiddenLoss& one : found) {
    const auto block = static_cast<std::size_t>(value(table.scene(one.row).removed.front()));
    CHECK(one.channels == std::vector<std::size_t>{2 * (block - 8), 2 * (block - 8) + 1});
    CHECK(one.gain == Approx(gain_of(bridge, observation, table.row(one.row))).epsilon(1e-5).margin(1e-5));
  }
}
