#pragma once
/// @file Can the best scene be the truth? The fit as a whole, and sensor by sensor.

#include <string>
#include <vector>

#include "database/records/database.h"
#include "lookup/evidence/evidence.h"

namespace voussoir {

struct Fit {
  bool explained = true;
  double chance = 1.0;  ///< of a fit as bad as this or worse if the scene is the truth
  std::string reason;   ///< in words, when the scene does not explain the readings
};

struct SensorResidual {
  std::size_t point = 0;
  double reading = 0.0;    ///< [m]
  double predicted = 0.0;  ///< [m]
  double scale = 0.0;      ///< [m] sigma (the bound of uniform noise); NaN at points that cannot move
  double error = 0.0;      ///< in units of sigma; NaN at points that cannot move
  bool disagrees = false;  ///< far outside what the other sensors show
};

/// A value for each reading; `scales` are those of the noise's level.
std::vector<SensorResidual> sensor_residuals(const Observation& observation, const ErrorScales& scales,
                                             std::span<const double> prediction);

/// With a stated level: is the scatter about the scene as small as the noise model says (Gaussian: chi
/// square; Laplace: sum of absolute errors; Student: sum of log terms; uniform: the bound)? With an unknown
/// level: is it below the largest level, and free of a pattern along the bridge (von Neumann's ratio of
/// successive differences)?
Fit check_fit(const std::vector<SensorResidual>& residuals, const NoiseEstimate& noise,
              double degrees_of_freedom);

}  // namespace voussoir
