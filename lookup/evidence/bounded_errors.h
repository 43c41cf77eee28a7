#pragma once
/// @file Bounded errors of instruments beside the model's own error: the convolution of a uniform and a
/// Gaussian distribution. A reading beyond the bound is then unlikely, not impossible.
///
/// With the half-width b, the standard deviation s and the upper tail Q of the standard Gaussian, the density
/// of the error e is
///     (Q((|e| - b) / s) - Q((|e| + b) / s)) / (2 b).

#include <span>

#include "lookup/evidence/row_at_levels.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// log of that density, within 1e-5. Precondition: s > 0.
double log_bounded_density(double error, double half_width, double deviation);

/// The chance of an error at least as large as |e|.
double chance_of_bounded_error(double error, double half_width, double deviation);

/// Sum of log_bounded_density over the readings, for each of these rows of a table; NaN if a reading has no
/// prediction. An unknown common factor is fitted (scale_fit.h); what the fit leaves open of it counts as a
/// model's error. Precondition: the observation has a model error or an unknown factor.
std::vector<double> log_bounded_likelihoods(const Observation& observation, const ErrorScales& scales,
                                            const SceneTable& table, std::span<const std::size_t> rows);

/// The same of a row at one level, whose errors have the scale 1/2 at places that are filled up.
double log_bounded_likelihood(const LevelPlaces& places);

/// Not below any of log_bounded_likelihoods, but for their rounding, in a fraction of the time.
std::vector<double> highest_bounded_likelihoods(const Observation& observation, const ErrorScales& scales,
                                                const SceneTable& table, std::span<const std::size_t> rows);

}  // namespace voussoir
