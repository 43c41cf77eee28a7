#pragma once
/// @file The part of the model's own error that all points of a scene share.

#include <span>
#include <vector>

#include "database/records/scene_table.h"

namespace voussoir {

/// (common rms(signal))^2 [m2] of these rows of a table; the signal is the row less `intact`, the root mean
/// square over the points that the row has.
std::vector<double> common_variances(std::span<const double> intact, double common, const SceneTable& table,
                                     std::span<const std::size_t> rows);

/// Of one row.
double common_variance(std::span<const double> intact, double common, std::span<const double> row);

}  // namespace voussoir
