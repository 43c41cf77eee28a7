#pragma once
/// @file Which sensors help most.

#include <cstddef>
#include <vector>

#include "lookup/plan/detectability.h"

namespace voussoir {

/// Rows of y, at most `count`, those first that help most: beginning with all, that row is left out in each
/// turn without which the most losses are still seen. How many are: the sum over blocks of the chance
/// exp(-L / D) that their loss is certain. L: the log of the likelihood ratio of loss and intact bridge that
/// makes it certain (`settings`), less what sensors add that fall silent with the block; D: the mean of that
/// log if the block is missing, the Kullback-Leibler divergence of the loss's Gaussian from the intact
/// bridge's in the rows that are read. That the log is distributed exponentially is an approximation, of
/// which docs/plan.md has the figures.
std::vector<Eigen::Index> rows_that_help(const UnknownBridge& bridge, const CaseNoise& noise,
                                         const SightSettings& settings, std::size_t count);

}  // namespace voussoir
