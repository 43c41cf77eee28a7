#pragma once
/// @file The probability (density) of the readings given a scene, for a stated noise level and over all levels.

#include "lookup/noise_model.h"
#include "lookup/row_statistics.h"

namespace voussoir {

/// log p(readings | scene) when all scales are `level` times those of the statistics. Shapes: uniform, Gaussian,
/// Laplace. -infinity for an impossible scene. Densities are per metre for each reading.
double log_likelihood(NoiseShape shape, const RowStatistics& statistics, std::size_t count, double level = 1.0);

/// log of the mean of p(readings | scene, level) over levels with a density uniform in log level between
/// kSmallestLevel and kLargestLevel; statistics taken with level 1. Uniform in closed form, Gaussian and Laplace by
/// Gauss-Legendre quadrature over the part of the range that matters (relative error below 1e-9).
double log_evidence(NoiseShape shape, const RowStatistics& statistics, std::size_t count);

/// An upper bound of log_evidence, cheap.
double log_evidence_bound(NoiseShape shape, const RowStatistics& statistics, std::size_t count);

/// The level at which these statistics (taken with level 1) are most likely, within the range of levels.
double likeliest_level(NoiseShape shape, const RowStatistics& statistics, std::size_t count);

/// log(exp(a) + exp(b)) without overflow; -infinity is the logarithm of zero.
double log_sum(double a, double b);

}  // namespace voussoir
