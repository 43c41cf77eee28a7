#pragma once
/// @file The Gaussian of readings with no block missing, in a form that is asked about other causes.

#include "lookup/unknown/unknown_bridge.h"

namespace voussoir {

/// [m2] of y in the bridge's case, all that scatters as the bridge file states.
Eigen::MatrixXd intact_covariance(const UnknownBridge& bridge);

/// With that covariance C.
struct IntactGaussian {
  Eigen::MatrixXd precision;  ///< C^-1
  Eigen::VectorXd pulled;     ///< C^-1 y
  double log = 0.0;           ///< density of all readings, but for what all cases have in common
};

IntactGaussian intact_gaussian(const UnknownBridge& bridge);

}  // namespace voussoir
