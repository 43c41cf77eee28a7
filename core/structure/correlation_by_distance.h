#pragma once
/// @file How alike parts of a bridge are that are near each other: laid by the same hands of the same stone,
/// damp, frozen or in the sun together. The correlation is exp(-distance / length): a part of a bridge may
/// differ from what lies beside it.

#include <Eigen/Core>
#include <vector>

#include "core/structure/structure.h"

namespace voussoir {

/// The length over which things are alike, as a share of the bridge's.
inline constexpr double kAlikeShare = 0.25;

/// Of what is at each of these places [m] with each.
Eigen::MatrixXd correlations_by_distance(const Structure& structure, const std::vector<Point>& places);

}  // namespace voussoir
