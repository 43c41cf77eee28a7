#pragma once
/// @file What readings say of the bridge itself and of the epochs, once the scenes' probabilities are known.

#include <Eigen/Cholesky>
#include <array>
#include <span>
#include <vector>

#include "lookup/unknown/unknown_evidence.h"

namespace voussoir {

/// A scene and how likely it is.
struct WeightedScene {
  std::size_t row = 0;
  double probability = 0.0;
};

/// One scene with one kappa in one case. With the covariance C = L L^T of y: E[z] = kappa A^T C^-1 r, and a
/// combination v of the basis's columns has the variance kappa |v|^2 - |kappa L^-1 A v|^2.
struct BridgePart {
  double weight = 0.0;
  double kappa = 1.0;
  Eigen::MatrixXd bridge;  ///< A
  Eigen::LLT<Eigen::MatrixXd> covariance;
  Eigen::VectorXd mean;  ///< of the basis's columns
};

/// A mixture over the likeliest scenes, over cases and over kappa: the parts that hold nearly all of it. All
/// parameters are standardised by the deviations that the file states.
struct BridgePosterior {
  std::vector<BridgePart> parts;
  std::array<double, kScatterFactors.size()> scatter{};  ///< probability of each of kScatterFactors
  Eigen::VectorXd bridge_mean;                           ///< of the basis's columns
  Eigen::VectorXd epoch_mean;  ///< of the columns of each epoch in y, the second's last
  Eigen::MatrixXd epoch_covariance;

  // What makes the readings, in the mean over the mixture; rows are those of y [m].
  Eigen::VectorXd signal;           ///< what missing blocks change, as the nominal bridge shows it
  Eigen::VectorXd from_bridge;      ///< expected of the parameters of the bridge
  Eigen::MatrixXd from_epochs;      ///< and of those of the epochs: a column for each parameter
  Eigen::VectorXd from_unevenness;  ///< of what is uneven in the epochs
  Eigen::VectorXd from_model;       ///< of what the model leaves of the intact bridge, and levellings
  Eigen::VectorXd left;             ///< of y
  double times_signal =
      1.0;  ///< how many times as large as in the model is what the likeliest scene's blocks change,
  double times_movement = 1.0;  ///< and what the intact bridge shows, after what is believed of the bridge
  Eigen::VectorXd beside;       ///< y less what all other readings let expect [m],
  Eigen::VectorXd spread;       ///< the standard deviation of that over all parts [m],
  Eigen::VectorXd others;       ///< and in standard deviations of each part, on average
  double square =
      1.0;  ///< square of the readings' whitened distance from what the scenes let expect, in units of what
            ///< the instruments' errors alone make of it on average: about 1 or more
  double chance = 1.0;  ///< of readings as far from what the scenes let expect as these, or farther: even
                        ///< between 0 and 1 over many questions if the model is right (chi square). What
                        ///< scenes without factors may be off by at each point does not count: it would
                        ///< explain any scatter
};

/// Scenes are possible ones, likeliest first; cases as likely beforehand as each other.
BridgePosterior bridge_posterior(const UnknownBridge& bridge, const Observation& observation,
                                 const SceneTable& table, const std::vector<WeightedScene>& scenes,
                                 std::span<const UnknownCase> cases);

/// What is known of one parameter of the bridge, in standard deviations that the file states.
struct ParameterEstimate {
  double mean = 0.0;
  double deviation = 1.0;
};

/// Of a parameter whose row of the basis is given.
ParameterEstimate parameter_estimate(const BridgePosterior& posterior, const Eigen::VectorXd& row);

}  // namespace voussoir
