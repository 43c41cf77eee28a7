#pragma once
/// @file The integral of a scene's likelihood over the noise level where errors are bounded.

#include <span>

#include "lookup/evidence/level_likelihood.h"
#include "lookup/evidence/level_rule.h"

namespace voussoir {

/// log of the integral of p(readings | scene, level) over log level from kSmallestLevel to kLargestLevel.
/// `likelihood` is that of the uniform shape; from now on its row is this one.
double log_bounded_integral(const Observation& observation, std::span<const double> prediction,
                            LevelRule rule, RowLikelihood& likelihood);

}  // namespace voussoir
