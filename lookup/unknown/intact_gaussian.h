#pragma once
/// @file The Gaussian of readings with no block missing, in a form that is asked about other causes.

#include <span>
#include <vector>

#include "lookup/unknown/case_noise.h"

namespace voussoir {

/// [m2] of y, all that scatters as the bridge file states.
Eigen::MatrixXd intact_covariance(const UnknownBridge& bridge, const CaseNoise& noise);

/// In one case, with that covariance C.
struct IntactGaussian {
  UnknownCase in_case;
  Eigen::MatrixXd precision;  ///< C^-1
  Eigen::VectorXd pulled;     ///< C^-1 y
  double log = 0.0;           ///< density of all readings, but for what all cases have in common
};

/// Of each of these cases.
std::vector<IntactGaussian> intact_gaussians(const UnknownBridge& bridge, const Observation& observation,
                                             std::span<const UnknownCase> cases);

}  // namespace voussoir
