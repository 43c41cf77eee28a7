#pragma once
/// @file Changes that might be read of a made-up bridge: sensors with errors, no readings yet.

#include "tests/lookup/unknown/made_up_factors.h"

namespace voussoir::test {

struct PlannedBridge {
  SyntheticLibrary library{3, 4, 2};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  Observation observation;
  UnknownBridge bridge;
  CaseNoise noise;

  /// `shown`: readings beside the intact bridge's [m].
  explicit PlannedBridge(double sigma, double shown = 0.0) {
    comparison.kind = ReadingKind::change;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, {}};
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      comparison.measured.displacement[i] =
          library.intact()[i] + shown * std::sin(static_cast<double>(5 * i));
      comparison.measured.sigma[i] = sigma;
    }
    look_at(observe(comparison, {NoiseShape::gaussian, 0.0}));
  }

  void look_at(const Observation& readings) {
    observation = readings;
    bridge = unknown_bridge(comparison, observation, {});
    noise = case_noise(bridge, observation, {0.0, 1.0});
  }
};

}  // namespace voussoir::test
