/// @file Estimates from a few combinations of the readings. Oracle: where there are no more readings than
/// directions, nothing is left out of a scene with at most one missing block, so that its estimate is the
/// evidence that is worked out from all readings.

#include "lookup/evidence/unknown_screen.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "lookup/evidence/unknown_evidence.h"
#include "tests/lookup/evidence/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("In as many directions as there are readings a single's estimate in each case is its evidence") {
  const ReadingKind kind = GENERATE(ReadingKind::absolute, ReadingKind::change);
  const SyntheticLibrary library{3, 4, 3};
  const Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  comparison.kind = kind;
  comparison.factors = factors_of(library, sensitivities);
  comparison.model_error = {0.02, 0.01, {}};
  for (std::size_t i = 1; i < library.points.size(); ++i) {
    comparison.measured.displacement[i] =
        library.table.row(5)[i] + 4e-5 * std::sin(static_cast<double>(7 * i));
    comparison.measured.sigma[i] = 2e-5;
  }
  const Observation observation = observe(comparison, {NoiseShape::gaussian, 0.0}, {});
  const std::vector<UnknownCase> cases = {{0.0, 3.0}, {0.0, 1.0}, {0.0, 0.2}};
  UnknownBridge bridge = unknown_bridge(comparison, observation, cases.front(), {});
  REQUIRE(bridge.rows.size() <= kDirections);
  const UnknownScreen screen(bridge, observation, library.table, cases, 2);
  std::size_t compared = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    set_case(observation, cases[k], bridge);
    for (std::size_t row = 0; row < library.table.rows && library.table.scene(row).missing() < 2; ++row) {
      const std::array<std::size_t, 1> rows = {row};
      const double evidence = over_scatter(scatter_logs(bridge, observation, library.table, rows, 1)[0]);
      const bool is_known = row == 0 || known_losses(bridge, library.table, row).count == 1;
      if (evidence == -kInfinity || !is_known) continue;
      std::vector<double> logs(cases.size(), kInfinity);
      screen.refine(std::array{ScreenedRow{row, -kInfinity, logs.data()}}, ScreenDirections::all);
      CAPTURE(row, k);
      REQUIRE(logs[k] == Approx(evidence).epsilon(1e-8));
      ++compared;
    }
  }
  CHECK(compared >= 20);
}
