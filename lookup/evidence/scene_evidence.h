#pragma once
/// @file The probability (density) of the readings given one scene, for a stated noise level and over all
/// levels, for the shapes whose statistics are short: uniform, Gaussian, Laplace.

#include "lookup/evidence/level_likelihood.h"
#include "lookup/evidence/row_statistics.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// log p(readings | scene) when all scales are `level` times those of the statistics. -infinity for an
/// impossible scene. Densities are per metre for each reading.
double log_likelihood(NoiseShape shape, const RowStatistics& statistics, std::size_t count,
                      double level = 1.0);

/// log of the mean of p(readings | scene, level) over levels with a density uniform in log level between
/// kSmallestLevel and kLargestLevel; statistics taken with level 1. Uniform in closed form, Gaussian and
/// Laplace by Gauss-Legendre quadrature over the part of the range that matters (relative error below 1e-9).
double log_evidence(NoiseShape shape, const RowStatistics& statistics, std::size_t count);

/// The level at which these statistics (taken with level 1) are most likely, within the range of levels.
double likeliest_level(NoiseShape shape, const RowStatistics& statistics, std::size_t count);

/// log(exp(a) + exp(b)) without overflow; -infinity is the logarithm of zero.
double log_sum(double a, double b);

}  // namespace voussoir
