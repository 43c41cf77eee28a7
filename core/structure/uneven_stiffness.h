#pragma once
/// @file How joints soften or stiffen from one epoch to another, some more than others.
///
/// Damp and frost reach one part of a bridge and not another. In every epoch the logarithm of each joint's
/// stiffness has a part of its own, normal with one standard deviation for all; those of two joints have the
/// correlation exp(-distance / length), so that where one softens its neighbours do, too, and a part of the
/// bridge may soften beside one that does not.

#include "core/structure/uncertain_parameters.h"

namespace voussoir {

/// The length over which joints are alike, as a share of the bridge's.
inline constexpr double kAlikeShare = 0.25;

struct UnevenStiffness {
  std::vector<UncertainAction> joints;  ///< of each pair of blocks that meet; none: all joints are alike
  std::vector<Point> places;            ///< of each of them, the middle of its first stretch [m]
  double length = 1.0;                  ///< [m]

  double correlation(std::size_t one, std::size_t other) const;
  /// Of one with each. All of them at once are many: as many as joints squared.
  Eigen::VectorXd correlations(std::size_t one) const;
};

UnevenStiffness uneven_stiffness(const Structure& structure, const Uncertainty& uncertainty);

/// One epoch's, drawn at random: the share of its stiffness that each joint of the structure keeps. The same
/// on every machine for the same seed.
Eigen::ArrayXd sampled_shares(const Structure& structure, const UnevenStiffness& uneven, std::uint64_t seed);

}  // namespace voussoir
