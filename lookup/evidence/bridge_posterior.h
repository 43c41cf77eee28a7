#pragma once
/// @file What readings say of the bridge itself and of the epochs, once the scenes' probabilities are known.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "lookup/evidence/unknown_evidence.h"

namespace voussoir {

/// A scene and how likely it is.
struct WeightedScene {
  std::size_t row = 0;
  double probability = 0.0;
};

/// A mixture over the likeliest scenes and over kappa, by its moments. All parameters are standardised.
struct BridgePosterior {
  std::array<double, kScatterFactors.size()> scatter{};  ///< probability of each of kScatterFactors
  double variance = 1.0;        ///< mean of kappa: of whatever the readings say nothing of
  Eigen::VectorXd bridge_mean;  ///< of the basis's columns
  Eigen::MatrixXd bridge_covariance;
  Eigen::VectorXd epoch_mean;  ///< of the parameters of each epoch in y, the second's last
  Eigen::MatrixXd epoch_covariance;

  // Of the likeliest scene; rows are those of y [m].
  Eigen::VectorXd signal;       ///< what the missing blocks change, as far as the nominal bridge says
  Eigen::VectorXd from_bridge;  ///< expected of the parameters of the bridge
  Eigen::MatrixXd from_epochs;  ///< and of each parameter of the epochs: a column for each parameter
  Eigen::VectorXd left;         ///< of the readings: y less all of these
  Eigen::VectorXd others;       ///< y less what all other readings let expect, in standard deviations of that
  double chance = 1.0;  ///< of readings as far from what the scenes let expect as these, or farther: even
                        ///< between 0 and 1 over many questions if the model is right (chi square)
};

/// Scenes are possible ones, likeliest first.
BridgePosterior bridge_posterior(const UnknownBridge& bridge, const Observation& observation,
                                 const SceneTable& table, const std::vector<WeightedScene>& scenes);

/// What is known of one parameter of the bridge.
struct ParameterEstimate {
  std::size_t parameter = 0;  ///< number in ReadingFactors::parameters
  double mean = 0.0;          ///< [standard deviations that the file states]
  double deviation = 1.0;
};

/// Of every parameter of the bridge, from what is known of the columns of the basis.
std::vector<ParameterEstimate> parameter_estimates(const BridgePosterior& posterior,
                                                   const Eigen::MatrixXd& basis);

}  // namespace voussoir
