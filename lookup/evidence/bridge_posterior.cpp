#include "lookup/evidence/bridge_posterior.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <optional>

#include "core/simd/column_products.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNegligibleWeight = 0.02;  // parts of the mixture with less weight are left out

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
      if (weight < kNegligibleWeight) continue;
      parts.push_back({i, k, weight});
      kept += weight;
    }
  }
  for (Part& part : parts) part.weight /= kept;
  return parts;
}

/// One scene's Gaussian, but for kappa.
struct SceneGaussian {
  SceneLoss loss;
  VectorXd difference;
  MatrixXd bridge, epoch, noise;
};

SceneGaussian scene_gaussian(const UnknownBridge& bridge, const Observation& observation,
                             const SceneTable& table, std::size_t row) {
  SceneGaussian scene{*scene_loss(bridge, observation, table, row), {}, {}, {}, {}};
  scene.difference = bridge.reading - scene.loss.signal;
  scene.bridge =
      in_rows(bridge.rows, bridge.factors->intact.bridge, bridge.factors->of(table.scene(row)).bridge);
  scene.epoch = bridge.conditions * epoch_columns(bridge, scene.loss);
  scene.noise = scene_noise(bridge, scene.loss);
  return scene;
}

/// What all others let expect of reading i is off by (C^-1 r)_i / (C^-1)_ii, which has the variance
/// 1 / (C^-1)_ii. The epochs' parameters have the mean E^T C^-1 r and the covariance I - E^T C^-1 E.
void add_part(const UnknownBridge& bridge, const SceneGaussian& scene, const MatrixXd& scatter, double kappa,
              double weight, BridgePosterior& result) {
  const Index n = scene.difference.size();
  BridgePart part{weight, kappa, scene.bridge, Eigen::LLT<MatrixXd>(scene.noise + kappa * scatter), {}};
  const auto lower = part.covariance.matrixL();
  const VectorXd whitened = lower.solve(scene.difference);
  const VectorXd pulled = lower.transpose().solve(whitened);
  part.mean = kappa * (scene.bridge.transpose() * pulled);
  const VectorXd epoch = scene.epoch.transpose() * pulled;
  const MatrixXd fall = lower.solve(scene.epoch);
  result.bridge_mean += weight * part.mean;
  result.epoch_mean += weight * epoch;
  result.from_unevenness += weight * (bridge.unevenness * pulled);
  result.epoch_covariance.diagonal().array() += weight;
  result.epoch_covariance += weight * (epoch * epoch.transpose() - fall.transpose() * fall);
  const MatrixXd inverse = lower.solve(MatrixXd::Identity(n, n));
  const VectorXd precision = inverse.colwise().squaredNorm();
  result.others += weight * (pulled.array() / precision.array().sqrt()).matrix();
  result.chance += weight * boost::math::gamma_q(0.5 * static_cast<double>(n), 0.5 * whitened.squaredNorm());
  result.parts.push_back(std::move(part));
}

/// What the means make of the likeliest scene's readings.
void explain(const UnknownBridge& bridge, const SceneGaussian& scene, BridgePosterior& result) {
  const Index parameters = bridge.factors->of_epoch();
  result.signal = scene.loss.signal;
  result.from_bridge = scene.bridge * result.bridge_mean;
  const MatrixXd each = scene.epoch * result.epoch_mean.asDiagonal();
  result.from_epochs = each.rightCols(parameters);
  if (bridge.epochs > 1) result.from_epochs += each.leftCols(parameters);
  result.left =
      scene.difference - result.from_bridge - result.from_epochs.rowwise().sum() - result.from_unevenness;
}

/// Parameters of the epochs were standardised by the deviations that the conditions have in this case.
void in_stated_deviations(double conditions, BridgePosterior& result) {
  result.epoch_mean *= conditions;
  result.epoch_covariance *= conditions * conditions;
}

BridgePosterior empty_posterior(const UnknownBridge& bridge) {
  const Index epochs = bridge.epochs * bridge.factors->of_epoch();
  BridgePosterior result;
  result.chance = 0.0;
  result.others = VectorXd::Zero(bridge.reading.size());
  result.from_unevenness = VectorXd::Zero(bridge.reading.size());
  result.bridge_mean = VectorXd::Zero(bridge.factors->of_bridge());
  result.epoch_mean = VectorXd::Zero(epochs);
  result.epoch_covariance = MatrixXd::Zero(epochs, epochs);
  return result;
}

}  // namespace

BridgePosterior bridge_posterior(const UnknownBridge& bridge, const Observation& observation,
                                 const SceneTable& table, const std::vector<WeightedScene>& scenes) {
  std::vector<std::size_t> rows;
  for (const WeightedScene& scene : scenes) rows.push_back(scene.row);
  BridgePosterior result = empty_posterior(bridge);
  const std::vector<Part> parts = parts_of(scenes, scatter_logs(bridge, observation, table, rows, 1));
  std::optional<SceneGaussian> likeliest;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (i > 0 && std::none_of(parts.begin(), parts.end(), [&](const Part& part) { return part.scene == i; }))
      continue;
    const SceneGaussian scene = scene_gaussian(bridge, observation, table, rows[i]);
    if (i == 0) likeliest = scene;
    const MatrixXd scatter = matrix_of(outer_product(scene.bridge), scene.bridge.rows());
    for (const Part& part : parts) {
      if (part.scene != i) continue;
      add_part(bridge, scene, scatter, kScatterFactors[part.kappa], part.weight, result);
      result.scatter[part.kappa] += part.weight;
    }
  }
  result.epoch_covariance -= result.epoch_mean * result.epoch_mean.transpose();
  explain(bridge, *likeliest, result);
  in_stated_deviations(bridge.conditions, result);
  return result;
}

ParameterEstimate parameter_estimate(const BridgePosterior& posterior, const VectorXd& row) {
  ParameterEstimate estimate{row.dot(posterior.bridge_mean), 0.0};
  double second = 0.0;
  for (const BridgePart& part : posterior.parts) {
    const VectorXd fall = part.kappa * part.covariance.matrixL().solve(part.bridge * row);
    const double mean = row.dot(part.mean);
    second += part.weight * (part.kappa - fall.squaredNorm() + mean * mean);
  }
  estimate.deviation = std::sqrt(std::max(0.0, second - estimate.mean * estimate.mean));
  return estimate;
}

}  // namespace voussoir
