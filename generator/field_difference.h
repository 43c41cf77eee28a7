#pragma once
/// @file How far apart two lists of displacements are.

#include <Eigen/Core>

namespace voussoir {

/// The largest difference [m] of two lists of equal length. Infinite if a displacement is there (not NaN) in
/// only one of them.
double largest_difference(const Eigen::Ref<const Eigen::VectorXd>& first,
                          const Eigen::Ref<const Eigen::VectorXd>& second);

}  // namespace voussoir
