#pragma once
/// @file The paper's objective: the one function by which every search scores a candidate.

#include <span>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// Keeps the logarithm of a perfect match finite (paper, Eq. 1).
inline constexpr double kMisfitGuard = 1e-16;

/// Sum of |reading - prediction| [m] over the readings (NaN: no reading), always in the same order of
/// additions. Infinite if a reading has no prediction (NaN): it was taken on a block that the scene lacks, so
/// the scene is impossible. Precondition: equal sizes.
double sum_of_differences(std::span<const double> readings, std::span<const double> prediction);

/// The paper's Eq. 1: log(sum + 1e-16) of a sum of differences [m].
double misfit_of(double sum);

/// Eq. 1 for one scene: log(sum_i |d_i^ex - d_i^j| + 1e-16), infinite for an impossible scene.
double misfit(std::span<const double> readings, std::span<const double> prediction);

/// sum_of_differences for each of these rows of a table.
std::vector<double> sums_of_differences(std::span<const double> readings, const SceneTable& table,
                                        std::span<const std::size_t> rows);

}  // namespace voussoir
