#pragma once
/// @file How alike joints are that are near each other: laid by the same hands of the same stone, damp or
/// frozen together. The correlation is exp(-distance / length): a part of a bridge may differ from what lies
/// beside it.

#include <Eigen/Core>
#include <vector>

#include "core/structure/structure.h"

namespace voussoir {

/// The length over which joints are alike, as a share of the bridge's.
inline constexpr double kAlikeShare = 0.25;

/// Of each of these joints with each, from one middle to the other.
Eigen::MatrixXd joint_correlations(const Structure& structure, const std::vector<std::size_t>& joints);

}  // namespace voussoir
