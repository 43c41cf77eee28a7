#pragma once
/// @file How joints soften or stiffen from one epoch to another, some more than others.
///
/// Damp and frost reach one part of a bridge and not another. In every epoch the logarithm of each joint's
/// stiffness has a part of its own, normal with one standard deviation for all and alike in joints that are
/// near each other (joint_correlation.h).

#include "core/structure/uncertain_parameters.h"

namespace voussoir {

struct UnevenStiffness {
  std::vector<UncertainAction> joints;  ///< of each pair of blocks that meet; none: all joints are alike
  Eigen::MatrixXd correlations;         ///< of each with each
};

UnevenStiffness uneven_stiffness(const Structure& structure, const Uncertainty& uncertainty);

/// One epoch's, drawn at random: the share of its stiffness that each joint of the structure keeps. The same
/// on every machine for the same seed.
Eigen::ArrayXd sampled_shares(const Structure& structure, const UnevenStiffness& uneven, std::uint64_t seed);

}  // namespace voussoir
