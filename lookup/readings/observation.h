#pragma once
/// @file What was observed: readings, how far each may be off, and the state that they are compared with.
/// Made once for a question; evidence, fit and residuals take it.

#include <span>
#include <vector>

#include "lookup/readings/comparison.h"
#include "lookup/readings/noise_model.h"
#include "lookup/readings/nuisance.h"

namespace voussoir {

/// All in the order of the library's points.
struct Observation {
  std::vector<double> displacement;  ///< [m] as measured, NaN where there is no reading: what Eq. 1 takes
  std::vector<double> reading;       ///< [m] the same, but NaN where nothing can move: it says nothing there
  std::vector<double> share;  ///< [-] of a movement, by which a reading is off at a noise level of one: 1, or
                              ///< 0 where the sensor states its own sigma
  std::vector<double> floor;  ///< [m] by which it is off besides: of the noise model, or the sensor's sigma
  std::vector<double> intact;  ///< [m] displacements of the intact bridge
  std::vector<double> origin;  ///< [m] from which movements count: zero, or `intact` if readings are changes
  std::vector<double> own_variance;  ///< [m2] of the model's error in `intact` as far as it is in what is
                                     ///< compared: none in changes
  double error_share = 0.0;          ///< ModelError of the signals
  double error_common = 0.0;
  double unknown_scale = 0.0;  ///< standard deviation of the common factor of all movements
  Eigen::MatrixXd levelling;   ///< levelling_columns: of the datum and the tilt of every levelling
  bool datum_stated = false;   ///< every levelling has a datum that is unknown to a stated deviation
  bool tilt_stated = false;    ///< every levelling has a tilt that is
  std::vector<bool> silent;    ///< there is a sensor, but it gave no reading
  NoiseModel noise;            ///< noise_of the readings
  std::size_t count = 0;       ///< of `reading`
  std::size_t moving = 0;      ///< of these at points that can move
  bool own_sigmas = false;     ///< some sensor states its own sigma
  bool unknown_level = false;  ///< some sensor does not, and nothing states the noise level

  std::vector<std::size_t> channels_read() const;  ///< those with a `reading`, ascending
  bool has_model_error() const;
  /// A reading beyond the bound of uniform noise is unlikely, not impossible.
  bool softens_bounds() const { return has_model_error() || unknown_scale > 0.0; }
  bool has_levelling() const { return levelling.cols() > 0; }
  /// All errors grow with the noise level alone, so that statistics for one level serve all.
  bool is_proportional() const {
    return noise.floor == 0.0 && !own_sigmas && !softens_bounds() && !has_levelling();
  }
};

/// Reading by reading what `comparison` holds, with the noise and the unknowns about it. Points that do not
/// move, neither in the intact bridge nor in singles, are held by a support: readings there say how that
/// moved and whether it is one, if their sensors state their own errors, and nothing if errors are a share of
/// what moves. Throws InputError for unknowns beside noise that is not Gaussian.
Observation observe(const Comparison& comparison, const NoiseModel& noise, const Nuisance& nuisance = {});

/// Throws InputError unless some reading can tell scenes apart.
void require_readings(const Observation& observation);

/// The instruments' errors at one noise level, in the order of the points: noise_scale's slope and offset.
struct ErrorScales {
  std::vector<double> slope;   ///< [-] zero where there is no reading
  std::vector<double> offset;  ///< [m] one where there is no reading
  double unit = 1.0;           ///< [m] a typical scale, which keeps products of scales within range
};
ErrorScales scales_at(const Observation& observation, double level);

/// The errors to be expected under a scene [m], NaN where there is no reading.
struct ExpectedErrors {
  std::vector<double> instrument;  ///< noise_scale
  std::vector<double> model;       ///< standard deviation: root of model_variance
};
ExpectedErrors expected_errors(const Observation& observation, const ErrorScales& scales,
                               std::span<const double> prediction);

}  // namespace voussoir
