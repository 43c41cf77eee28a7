#pragma once
/// @file How far readings scatter of a bridge that is not exactly known, in one case.

#include <Eigen/Core>
#include <array>

#include "lookup/unknown/unknown_bridge.h"

namespace voussoir {

/// Conditions differ from the model's by this much of what the bridge file states, in every epoch alike: by
/// all of it, or, each as likely beforehand, hardly. One standard deviation for all would count every epoch
/// as warm and moved; what heat does to joints is not linear, and its error would drown what a block does.
/// The readings decide. Without anything between 0.2 and 1 a foot that alone is 1.1 to 1.5 deviations lower
/// was damage at times: what else had not happened spoke for 0.2. At 0.8 what the first order leaves
/// (case_noise) has a little more than the variance that it has on average; with 0.5 in its place it had a
/// fourth or fourfold, and bridges that leave less than others were told as if they left half.
inline constexpr std::array<double, 5> kConditionSizes = {0.03, 0.3, 0.8, 1.0, 3.0};

/// What is gone through, as it is neither Gaussian nor linear.
struct UnknownCase {
  double level = 0.0;  ///< of the noise
  double conditions =
      1.0;  ///< of what the bridge file states: one of kConditionSizes, or 0 if they are known
};

/// By how much the readings of all scenes scatter in a case, but for what parameters and losses add.
struct CaseNoise {
  double conditions = 1.0;      ///< UnknownCase::conditions
  Eigen::VectorXd instruments;  ///< [m2] variance of each row's instrument
  double least_variance = 0.0;  ///< [m2] the least of them, of one epoch
  Eigen::MatrixXd covariance;   ///< [m2] instruments, and what UnknownBridge knows of noise
  double spread = 0.0;  ///< [-] standard deviation of a signal as a share of it, where it is not known better
};

/// The instruments' errors are those of the case's level, in shares of what was read; what the first order
/// leaves of conditions goes with their size.
CaseNoise case_noise(const UnknownBridge& bridge, const Observation& observation, const UnknownCase& one);

/// Everything that adds to the covariance of a scene's readings, but for A A^T: noise, E E^T and what else is
/// uncertain; and its signal beyond known losses, by one factor and, of unknown ones, at each point.
Eigen::MatrixXd scene_noise(const UnknownBridge& bridge, const CaseNoise& noise, const SceneLoss& loss);

}  // namespace voussoir
