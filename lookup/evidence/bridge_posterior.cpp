#include "lookup/evidence/bridge_posterior.h"

#include <Eigen/Cholesky>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNegligible = 1e-4;  // parts of the mixture with less weight are left out

/// A scene with one kappa, and its weight in the mixture.
struct Part {
  std::size_t scene;
  std::size_t kappa;
  double weight;
};

std::vector<Part> parts_of(const std::vector<WeightedScene>& scenes, const std::vector<ScatterLogs>& logs) {
  double total = 0.0;
  for (const WeightedScene& scene : scenes) total += scene.probability;
  std::vector<Part> parts;
  double kept = 0.0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const double log_all = over_scatter(logs[i]);
    for (std::size_t k = 0; k < kScatterFactors.size(); ++k) {
      const double weight = scenes[i].probability / total * kScatterPrior[k] * std::exp(logs[i][k] - log_all);
      if (weight < kNegligible) continue;
      parts.push_back({i, k, weight});
      kept += weight;
    }
  }
  for (Part& part : parts) part.weight /= kept;
  return parts;
}

/// Mean and covariance of a mixture of Gaussians, part by part.
class Moments {
 public:
  explicit Moments(Index size) : mean_(VectorXd::Zero(size)), second_(MatrixXd::Zero(size, size)) {}

  /// A part with the covariance variance * I - fall^T fall.
  void add(double weight, const VectorXd& mean, double variance, const MatrixXd& fall) {
    mean_ += weight * mean;
    second_.diagonal().array() += weight * variance;
    second_.selfadjointView<Eigen::Lower>().rankUpdate(fall.transpose(), -weight);
    second_.selfadjointView<Eigen::Lower>().rankUpdate(mean, weight);
  }
  const VectorXd& mean() const { return mean_; }
  MatrixXd covariance() const {
    return MatrixXd(second_.selfadjointView<Eigen::Lower>()) - mean_ * mean_.transpose();
  }

 private:
  VectorXd mean_;
  MatrixXd second_;
};

/// With the covariance C = L L^T: E[z] = kappa A^T C^-1 r and cov(z) = kappa I - kappa^2 A^T C^-1 A; what all
/// others let expect of reading i is off by (C^-1 r)_i / (C^-1)_ii, a variance of 1 / (C^-1)_ii.
void add_part(const UnknownBridge& bridge, const SceneGaussian& scene, double kappa, double weight,
              Moments& of_bridge, Moments& of_epochs, BridgePosterior& result) {
  const Eigen::LLT<MatrixXd> factorised(scene.covariance(bridge, kappa));
  const auto lower = factorised.matrixL();
  const VectorXd whitened = lower.solve(scene.difference);
  const MatrixXd from_bridge = lower.solve(scene.factors.bridge);
  const MatrixXd from_epochs = lower.solve(scene.factors.epoch);
  of_bridge.add(weight, kappa * (from_bridge.transpose() * whitened), kappa, kappa * from_bridge);
  of_epochs.add(weight, from_epochs.transpose() * whitened, 1.0, from_epochs);
  const Index n = whitened.size();
  const MatrixXd inverse = lower.solve(MatrixXd::Identity(n, n));
  const VectorXd precision = inverse.colwise().squaredNorm();
  const VectorXd pulled = inverse.transpose() * whitened;
  result.others += weight * (pulled.array() / precision.array().sqrt()).matrix();
  result.chance += weight * boost::math::gamma_q(0.5 * static_cast<double>(n), 0.5 * whitened.squaredNorm());
  result.variance += weight * kappa;
}

/// What the means make of the likeliest scene's readings.
void explain(const UnknownBridge& bridge, const SceneGaussian& scene, BridgePosterior& result) {
  const Index parameters = scene.factors.epoch.cols() / bridge.epochs;
  result.signal = bridge.reading - scene.difference;
  result.from_bridge = scene.factors.bridge * result.bridge_mean;
  const MatrixXd each = scene.factors.epoch * result.epoch_mean.asDiagonal();
  result.from_epochs = each.rightCols(parameters);
  if (bridge.epochs > 1) result.from_epochs += each.leftCols(parameters);
  result.left = scene.difference - result.from_bridge - result.from_epochs.rowwise().sum();
}

}  // namespace

BridgePosterior bridge_posterior(const UnknownBridge& bridge, const Observation& observation,
                                 const SceneTable& table, const std::vector<WeightedScene>& scenes) {
  std::vector<std::size_t> rows;
  for (const WeightedScene& scene : scenes) rows.push_back(scene.row);
  BridgePosterior result;
  result.chance = result.variance = 0.0;
  result.others = VectorXd::Zero(bridge.reading.size());
  Moments of_bridge(bridge.intact.bridge.cols()), of_epochs(bridge.intact.epoch.cols());
  for (const Part& part : parts_of(scenes, scatter_logs(bridge, observation, table, rows, 1))) {
    const auto scene = scene_gaussian(bridge, observation, table, rows[part.scene]);
    add_part(bridge, *scene, kScatterFactors[part.kappa], part.weight, of_bridge, of_epochs, result);
    result.scatter[part.kappa] += part.weight;
  }
  result.bridge_mean = of_bridge.mean();
  result.bridge_covariance = of_bridge.covariance();
  result.epoch_mean = of_epochs.mean();
  result.epoch_covariance = of_epochs.covariance();
  explain(bridge, *scene_gaussian(bridge, observation, table, rows.front()), result);
  return result;
}

std::vector<ParameterEstimate> parameter_estimates(const BridgePosterior& posterior, const MatrixXd& basis) {
  const VectorXd mean = basis * posterior.bridge_mean;
  std::vector<ParameterEstimate> estimates;
  for (Index i = 0; i < basis.rows(); ++i) {
    const double outside = 1.0 - std::min(1.0, basis.row(i).squaredNorm());
    const double inside = basis.row(i).dot(basis.row(i) * posterior.bridge_covariance);
    estimates.push_back(
        {static_cast<std::size_t>(i), mean[i], std::sqrt(outside * posterior.variance + inside)});
  }
  return estimates;
}

}  // namespace voussoir
