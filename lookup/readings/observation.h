#pragma once
/// @file What was observed: readings, how far each may be off, and the state that they are compared with.
/// Made once for a question; evidence, fit and residuals take it.

#include <span>
#include <vector>

#include "lookup/readings/comparison.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// All in the order of the library's points.
struct Observation {
  std::vector<double> displacement;  ///< [m] as measured, NaN where there is no reading: what Eq. 1 takes
  std::vector<double> reading;       ///< [m] the same, but NaN where nothing can move: it says nothing there
  std::vector<double> share;  ///< [-] of a movement, by which a reading is off at a noise level of one: 1, or
                              ///< 0 where the sensor states its own sigma
  std::vector<double> floor;  ///< [m] by which it is off besides: of the noise model, or the sensor's sigma
  std::vector<double> intact;  ///< [m] displacements of the intact bridge
  std::vector<double>
      origin;  ///< [m] from which movements count: zero, or `intact` if the readings are changes
  std::vector<double> own_error;  ///< [m] standard deviation of the model's error in `intact`, as far as it
                                  ///< is in what is compared: none in changes
  double error_share = 0.0;  ///< ModelError of the signals
  double error_common = 0.0;
  std::vector<bool> silent;  ///< there is a sensor, but it gave no reading
  NoiseModel noise;
  std::size_t count = 0;    ///< of `reading`
  bool own_sigmas = false;  ///< some sensor states its own sigma

  /// False if all errors grow with the noise level alone, so that statistics for one level serve all.
  bool has_absolute_errors() const { return noise.floor > 0.0 || noise.model_error > 0.0 || own_sigmas; }
};

/// `intact` are the displacements of the intact bridge: points that do not move there are held by a support
/// and move in no scene.
Observation observe(const Comparison& comparison, std::span<const double> intact, const NoiseModel& noise);

/// Of absolute readings, with a model that has no error of its own.
Observation observe(const Measurements& measurements, std::span<const double> intact,
                    const NoiseModel& noise);

/// Throws InputError unless some reading can tell scenes apart.
void require_readings(const Observation& observation);

/// The errors at one noise level, in the order of the points: noise_scale's slope and offset.
struct ErrorScales {
  std::vector<double> slope;   ///< [-] zero where there is no reading
  std::vector<double> offset;  ///< [m] one where there is no reading
  double unit = 1.0;           ///< [m] a typical scale, which keeps products of scales within range
};
ErrorScales scales_at(const Observation& observation, double level);

/// noise_scale of each reading under a scene [m]; NaN where there is no reading.
std::vector<double> error_scales(const Observation& observation, const ErrorScales& scales,
                                 std::span<const double> prediction);

}  // namespace voussoir
