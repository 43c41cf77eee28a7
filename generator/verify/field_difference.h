#pragma once
/// @file How far apart two lists of displacements are.

#include <Eigen/Core>

namespace voussoir {

/// Two separate solutions of the same scene may differ by this much [m]: the solver stops at a residual of
/// 1e-8 of a block's weight, which the softest motions of a bridge turn into less than a nanometre.
inline constexpr double kSameDisplacement = 1e-9;

/// The largest difference [m] of two lists of equal length. Infinite if a displacement is there (not NaN) in
/// only one of them.
double largest_difference(const Eigen::Ref<const Eigen::VectorXd>& first,
                          const Eigen::Ref<const Eigen::VectorXd>& second);

}  // namespace voussoir
