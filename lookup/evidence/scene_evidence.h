#pragma once
/// @file The probability (density) of the readings given one scene, for a stated noise level and over all
/// levels, for the shapes whose statistics are short: uniform, Gaussian, Laplace.

#include <limits>

#include "lookup/evidence/row_statistics.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// The logarithm of an impossible scene's probability.
inline constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// Errors may exceed the bound of uniform noise by this share of it: rounding.
inline constexpr double kBoundTolerance = 1e-9;

/// Logarithms that are worked out in different orders differ by no more than this share of themselves.
inline constexpr double kLogRoundOff = 1e-6;

/// log p(readings | scene) when all scales are `level` times those of the statistics. -infinity for an
/// impossible scene. Densities are per metre for each reading.
double log_likelihood(NoiseShape shape, const RowStatistics& statistics, std::size_t count,
                      double level = 1.0);

/// The same for uniform noise that is taken to explain all errors, of a possible scene.
double log_within_bound(const RowStatistics& statistics, std::size_t count, double level);

/// The same for Student's t at the statistics' own level, of a possible scene.
double student_log_likelihood(const RowStatistics& statistics, std::size_t count, double degrees_of_freedom);

/// log of the mean of p(readings | scene, level) over levels with a density uniform in log level between
/// kSmallestLevel and kLargestLevel; statistics taken with level 1. Uniform in closed form, Gaussian and
/// Laplace by Gauss-Legendre quadrature over the part of the range that matters (relative error below 1e-9).
double log_evidence(NoiseShape shape, const RowStatistics& statistics, std::size_t count);

/// How many times the level that they were taken with (`taken_at`) these statistics are likeliest at, within
/// the range of levels.
double likeliest_level(NoiseShape shape, const RowStatistics& statistics, std::size_t count,
                       double taken_at = 1.0);

/// log(exp(a) + exp(b)) without overflow; -infinity is the logarithm of zero, infinity stays what it is.
double log_sum(double a, double b);

}  // namespace voussoir
