#pragma once
/// @file What readings say of the bridge itself and of the epochs, once the scenes' probabilities are known.

#include <Eigen/Cholesky>
#include <array>
#include <span>
#include <vector>

#include "lookup/evidence/unknown_evidence.h"

namespace voussoir {

/// A scene and how likely it is.
struct WeightedScene {
  std::size_t row = 0;
  double probability = 0.0;
};

/// One scene with one kappa. With the covariance C = L L^T of y: E[z] = kappa A^T C^-1 r, and a combination v
/// of the basis's columns has the variance kappa |v|^2 - |kappa L^-1 A v|^2.
struct BridgePart {
  double weight = 0.0;
  double kappa = 1.0;
  Eigen::MatrixXd bridge;  ///< A
  Eigen::LLT<Eigen::MatrixXd> covariance;
  Eigen::VectorXd mean;  ///< of the basis's columns
};

/// A mixture over the likeliest scenes and over kappa. All parameters are standardised
/// by the deviations that the file states.
struct BridgePosterior {
  std::vector<BridgePart> parts;
  std::array<double, kScatterFactors.size()> scatter{};  ///< probability of each of kScatterFactors
  Eigen::VectorXd bridge_mean;                           ///< of the basis's columns
  Eigen::VectorXd epoch_mean;  ///< of the parameters of each epoch in y, the second's last
  Eigen::MatrixXd epoch_covariance;

  // Of the likeliest scene; rows are those of y [m].
  Eigen::VectorXd signal;           ///< what the missing blocks change, as the nominal bridge shows it
  Eigen::VectorXd from_bridge;      ///< expected of the parameters of the bridge
  Eigen::MatrixXd from_epochs;      ///< and of those of the epochs: a column for each parameter
  Eigen::VectorXd from_unevenness;  ///< of what is uneven in the epochs
  Eigen::VectorXd left;             ///< of y
  Eigen::VectorXd others;  ///< y less what all other readings let expect, in standard deviations of that
  double chance = 1.0;     ///< of readings as far from what the scenes let expect as these, or farther: even
                           ///< between 0 and 1 over many questions if the model is right (chi square)
};

/// Scenes are possible ones, likeliest first.
BridgePosterior bridge_posterior(const UnknownBridge& bridge, const Observation& observation,
                                 const SceneTable& table, const std::vector<WeightedScene>& scenes);

/// What is known of one parameter of the bridge, in standard deviations that the file states.
struct ParameterEstimate {
  double mean = 0.0;
  double deviation = 1.0;
};

/// Of a parameter whose row of the basis is given.
ParameterEstimate parameter_estimate(const BridgePosterior& posterior, const Eigen::VectorXd& row);

}  // namespace voussoir
