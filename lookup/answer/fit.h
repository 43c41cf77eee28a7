#pragma once
/// @file Can the best scene be the truth? The fit as a whole, and sensor by sensor.

#include <optional>
#include <string>
#include <vector>

#include "database/records/database.h"
#include "lookup/evidence/evidence.h"
#include "lookup/unknown/bridge_posterior.h"

namespace voussoir {

/// A scene explains readings whose fit is at least this likely.
inline constexpr double kSmallestChance = 1e-4;

struct Fit {
  bool explained = true;
  double chance = 1.0;  ///< of a fit as bad as this or worse if the scene is the truth: even between 0 and 1
                        ///< over many questions if the model and the stated noise are right
  std::string reason;   ///< in words, when the scene does not explain the readings
  /// Readings, of one sensor or of one block, that may be wrong and decide, the likeliest to be wrong first;
  /// none where something else is the reason.
  std::vector<std::vector<std::size_t>> suspects{};
};

struct SensorResidual {
  std::size_t point = 0;
  double reading = 0.0;    ///< [m]
  double predicted = 0.0;  ///< [m]
  double scale = 0.0;  ///< [m] of the instrument (the bound of uniform noise) and the model together, or of
                       ///< all that an uncertain bridge leaves open; NaN at points that cannot move
  double error = 0.0;  ///< reading less prediction in units of `scale`; NaN at points that cannot move
  bool disagrees = false;  ///< far outside what the other sensors show
};

/// A value for each reading; `scales` are those of the noise's level. An unknown datum, tilt or scale is part
/// of what is predicted, as far as the readings show it.
std::vector<SensorResidual> sensor_residuals(const Observation& observation, const ErrorScales& scales,
                                             std::span<const double> prediction);

/// Those that disagree, the farthest first.
std::vector<SensorResidual> disagreeing(const std::vector<SensorResidual>& residuals);

/// The predictive check of one scene. With a stated level: how likely is a scatter as large as this
/// (Gaussian, and with nuisances: chi square; Laplace: sum of absolute errors; Student and uniform: Fisher's
/// sum of the logarithms of every error's chance)? With an unknown level: is it below the largest level, and
/// free of a pattern along the bridge (von Neumann's ratio of successive differences)?
Fit check_fit(const Observation& observation, const NoiseEstimate& noise, std::span<const double> prediction);

/// How far a reading may be from its prediction, in units of `error`, without disagreeing: eight times as far
/// as half of them are; infinite where there are too few to say.
double limit_of_agreement(const std::vector<SensorResidual>& residuals);

/// The same of a bridge that is not exactly known. `predicted` is what all other readings let expect, `scale`
/// the standard deviation of the reading about that.
std::vector<SensorResidual> sensor_residuals(const Observation& observation, const UnknownBridge& bridge,
                                             const BridgePosterior& posterior);
Fit check_fit(const BridgePosterior& posterior);

/// Does what is believed of the bridge make the model move by less than a fifth or more than five times? To
/// first order readings with the wrong sign or unit are those of a bridge that rises under its weight. Null
/// if it does not.
std::optional<Fit> check_sizes(const BridgePosterior& posterior);

}  // namespace voussoir
