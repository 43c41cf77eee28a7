/// @file Estimates from a few combinations of the readings. Oracle: where there are no more readings than
/// directions, nothing is left out of a scene with at most one missing block, so that its estimate is the
/// evidence that is worked out from all readings.

#include "lookup/unknown/unknown_screen.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "lookup/unknown/unknown_evidence.h"
#include "tests/lookup/evidence/textbook_likelihood.h"
#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;

namespace {

constexpr double kRight = 1e-4;       // single precision, of sums of some dozen numbers
constexpr double kAHundredth = 1e-2;  // that is promised

/// Readings of a change or of displacements, at all points but the first.
struct AskedBridge {
  SyntheticLibrary library{3, 4, 3};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  explicit AskedBridge(ReadingKind kind) {
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, {}};
    for (std::size_t i = 1; i < library.points.size(); ++i) {
      comparison.measured.displacement[i] =
          library.table.row(5)[i] + 4e-5 * std::sin(static_cast<double>(7 * i));
      comparison.measured.sigma[i] = 2e-5;
    }
  }
};

/// How often a single's estimate in all directions was compared with its evidence in one of the cases.
int compare_estimates(const AskedBridge& asked, const UnknownSettings& settings, double margin,
                      const std::function<bool(std::size_t row, const UnknownBridge&)>& counts) {
  const SceneTable& table = asked.library.table;
  const Observation observation = observe(asked.comparison, {NoiseShape::gaussian, 0.0}, {});
  const std::vector<UnknownCase> cases = {{0.0, 3.0}, {0.0, 1.0}, {0.0, 0.2}};
  const UnknownBridge bridge = unknown_bridge(asked.comparison, observation, settings);
  REQUIRE(bridge.rows.size() <= kDirections);
  const UnknownScreen screen(bridge, observation, table, cases, {}, 2);
  int compared = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const CaseNoise noise = case_noise(bridge, observation, cases[k]);
    for (std::size_t row = 0; row < table.rows && table.scene(row).missing() < 2; ++row) {
      const std::array<std::size_t, 1> rows = {row};
      const double evidence = over_scatter(scatter_logs(bridge, noise, observation, table, rows, 1)[0]);
      if (evidence == -kInfinity || !counts(row, bridge)) continue;
      std::vector<float> logs(cases.size(), static_cast<float>(kInfinity));
      screen.refine(std::array{ScreenedRow{row, -kInfinity, logs.data()}}, ScreenDirections::all);
      CAPTURE(row, k);
      REQUIRE(std::abs(static_cast<double>(logs[k]) - evidence) < margin);
      ++compared;
    }
  }
  return compared;
}

}  // namespace

TEST_CASE("In as many directions as there are readings a single's estimate in each case is its evidence") {
  const AskedBridge asked(GENERATE(ReadingKind::absolute, ReadingKind::change));
  CHECK(compare_estimates(asked, {}, kRight, [&](std::size_t row, const UnknownBridge& bridge) {
          return row == 0 || known_losses(bridge, asked.library.table, row).count == 1;
        }) >= 20);
}

TEST_CASE("So is that of a collapse by metres, beside which single precision would lose the first epoch") {
  AskedBridge asked(ReadingKind::change);
  SyntheticLibrary& library = asked.library;
  const std::size_t points = library.points.size();
  for (std::size_t row = 0; row < library.table.rows; ++row)
    for (std::size_t i = 0; i < points && library.outcome[row] != 0; ++i)
      library.vertical[row * points + i] -= 2.0 + 0.1 * static_cast<double>(i % 5);
  asked.comparison.before.assign(asked.comparison.measured.displacement.begin(),
                                 asked.comparison.measured.displacement.end());
  CHECK(compare_estimates(asked, {.epochs = Epochs::both}, kAHundredth,
                          [&](std::size_t row, const UnknownBridge&) { return library.outcome[row] != 0; }) >=
        3);
}
