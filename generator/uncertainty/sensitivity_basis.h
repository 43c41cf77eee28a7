#pragma once
/// @file The few directions of a bridge's parameters that its displacements and signals depend on.

#include <Eigen/Core>
#include <vector>

namespace voussoir {

/// The basis holds what the intact bridge's displacements depend on, down to this standard deviation [m]: a
/// hundredth of what good gauges read.
inline constexpr double kLeastDeviation = 1e-7;

/// And of the variance of every signal, taken on average over scenes and states, all but this share.
inline constexpr double kLeftOfSignals = 1e-3;

/// Of each kept state and each scene: points x parameters (the bridge's first) [m per standard deviation];
/// those of the intact bridge come first. Empty ones are not known.
using Derivatives = std::vector<std::vector<Eigen::MatrixXd>>;

/// The bridge's parameters along orthonormal directions of the independent ones that the factor (L) makes
/// them of: L V, a column a direction; see kLeastDeviation and kLeftOfSignals. The same bits on any number of
/// threads (0: one for each core).
Eigen::MatrixXd sensitivity_basis(const Derivatives& derivatives, const Eigen::MatrixXd& correlation_factor,
                                  int threads = 0);

}  // namespace voussoir
