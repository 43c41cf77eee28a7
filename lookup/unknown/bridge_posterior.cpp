#include "lookup/unknown/bridge_posterior.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/simd/column_products.h"
#include "core/threads.h"
#include "lookup/evidence/chi_square.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Parts of the mixture that hold less than this together are left out.
constexpr double kLeftOut = 0.02;

/// A scene in one case with one kappa, and its weight in the mixture.
struct Part {
  std::size_t scene;
  std::size_t in_case;
  std::size_t kappa;
  double weight;
};

/// All of them, the heaviest first.
std::vector<Part> mixture_parts(const UnknownBridge& bridge, const Observation& observation,
                                const SceneTable& table, const std::vector<WeightedScene>& scenes,
                                std::span<const UnknownCase> cases) {
  std::vector<std::size_t> rows;
  for (const WeightedScene& scene : scenes) rows.push_back(scene.row);
  const std::vector<CaseTerms> terms = case_terms(bridge, observation, cases);
  const std::vector<ScatterLogs> logs =
      SceneLikelihoods(bridge, observation, table)(terms, rows, {}, hardware_threads());
  double total = 0.0;
  for (const WeightedScene& scene : scenes) total += scene.probability;
  std::vector<Part> parts;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto of_scene = std::span(logs).subspan(i * cases.size(), cases.size());
    double log_all = kImpossible;
    for (const ScatterLogs& one : of_scene) log_all = log_sum(log_all, over_scatter(one));
    for (std::size_t c = 0; c < cases.size(); ++c)
      for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
        parts.push_back(
            {i, c, k, scenes[i].probability / total * kScatterPrior[k] * std::exp(of_scene[c][k] - log_all)});
  }
  std::ranges::stable_sort(parts, std::ranges::greater{}, &Part::weight);
  return parts;
}

/// The heaviest parts, with weights that sum up to one.
std::vector<Part> heaviest(std::span<const Part> parts) {
  std::vector<Part> kept;
  double sum = 0.0;
  for (const Part& part : parts) {
    if (sum >= 1.0 - kLeftOut) break;
    kept.push_back(part);
    sum += part.weight;
  }
  for (Part& part : kept) part.weight /= sum;
  return kept;
}

/// What no case changes of a scene's Gaussian.
struct SceneGaussian {
  SceneLoss loss;
  VectorXd difference;
  MatrixXd bridge, scatter, epoch;  // A, A A^T; E of conditions as the file states them
};

SceneGaussian scene_gaussian(const UnknownBridge& bridge, const Observation& observation,
                             const SceneTable& table, std::size_t row) {
  SceneGaussian scene{*scene_loss(bridge, observation, table, row), {}, {}, {}, {}};
  scene.difference = bridge.reading - scene.loss.signal;
  scene.bridge = bridge_columns(bridge, table.scene(row));
  scene.scatter = matrix_of(outer_product(scene.bridge), scene.bridge.rows());
  scene.epoch = epoch_columns(bridge, scene.loss);
  return scene;
}

/// Of readings as far away as these if scenes without factors are not off at each point by itself.
double chance_of(const UnknownBridge& bridge, const CaseNoise& noise, const SceneGaussian& scene,
                 const MatrixXd& covariance, double whitened_square) {
  const auto n = static_cast<double>(scene.difference.size());
  double square = whitened_square;
  if (scene.loss.square_at_points > 0.0) {
    SceneLoss loss = scene.loss;
    loss.square_at_points = 0.0;
    const MatrixXd less =
        covariance - scene_noise(bridge, noise, scene.loss) + scene_noise(bridge, noise, loss);
    square = scene.difference.dot(less.llt().solve(scene.difference));
  }
  return chi_square_chance(square, n);
}

/// What the parts of one scene hold together, and the sums of their means, each with its weight.
struct SceneMeans {
  double weight = 0.0;
  VectorXd bridge, epoch;
};

/// What these make of the scene's readings.
void add_causes(const UnknownBridge& bridge, const SceneGaussian& scene, const SceneMeans& means,
                BridgePosterior& result) {
  const Index parameters = bridge.factors->epoch_parameters();
  result.signal += means.weight * scene.loss.signal;
  result.from_bridge += scene.bridge * means.bridge;
  const MatrixXd each = scene.epoch * means.epoch.asDiagonal();
  result.from_epochs += each.rightCols(bridge.factors->of_epoch()).leftCols(parameters);
  if (bridge.epochs > 1) result.from_epochs += each.leftCols(parameters);
}

/// What all others let expect of reading i is off by (C^-1 r)_i / (C^-1)_ii, which has the variance
/// 1 / (C^-1)_ii. The epochs' parameters have the mean E^T C^-1 r and the covariance I - E^T C^-1 E, in
/// deviations of the case.
void add_part(const UnknownBridge& bridge, const CaseNoise& noise, const SceneGaussian& scene, double kappa,
              double weight, SceneMeans& means, BridgePosterior& result) {
  const Index n = scene.difference.size();
  const double size = noise.conditions;
  const MatrixXd covariance = scene_noise(bridge, noise, scene.loss) + kappa * scene.scatter;
  BridgePart part{weight, kappa, scene.bridge, Eigen::LLT<MatrixXd>(covariance), {}};
  const auto lower = part.covariance.matrixL();
  const VectorXd whitened = lower.solve(scene.difference);
  const VectorXd pulled = lower.transpose().solve(whitened);
  part.mean = kappa * (scene.bridge.transpose() * pulled);
  const VectorXd epoch = size * size * (scene.epoch.transpose() * pulled);
  const MatrixXd fall = size * size * lower.solve(scene.epoch);
  means.weight += weight;
  means.bridge += weight * part.mean;
  means.epoch += weight * epoch;
  result.from_unevenness += weight * (bridge.unevenness * pulled);
  // The expected common factor of all movements (Nuisance::scale), which moves the intact bridge, too.
  const double factor = bridge.scale * bridge.scale * (bridge.movement + scene.loss.signal).dot(pulled);
  result.from_model += weight * (bridge.fixed_noise * pulled + factor * bridge.movement);
  result.epoch_covariance.diagonal().array() += weight * size * size;
  result.epoch_covariance += weight * (epoch * epoch.transpose() - fall.transpose() * fall);
  const MatrixXd inverse = lower.solve(MatrixXd::Identity(n, n));
  const VectorXd precision = inverse.colwise().squaredNorm();
  result.square += weight * whitened.squaredNorm() / noise.instruments.dot(precision);
  const VectorXd beside = pulled.cwiseQuotient(precision);
  result.beside += weight * beside;
  result.spread += weight * (precision.cwiseInverse() + beside.cwiseAbs2());
  result.others += weight * (pulled.array() / precision.array().sqrt()).matrix();
  result.chance += weight * chance_of(bridge, noise, scene, covariance, whitened.squaredNorm());
  result.parts.push_back(std::move(part));
}

/// By how many times as much something moves if `more` comes on top, seen along it.
double times_of(const VectorXd& movement, const VectorXd& more) {
  return movement.isZero(0.0) ? 1.0 : 1.0 + movement.dot(more) / movement.squaredNorm();
}

/// By how many times as much as in the model things move: what the likeliest scene loses if it is the truth,
/// and the intact bridge.
void compare_with_model(const UnknownBridge& bridge, const Observation& observation,
                        const SceneGaussian& first, const SceneMeans& means, BridgePosterior& result) {
  const MatrixXd intact = bridge_columns(bridge, {});
  if (means.weight > 0.0)
    result.times_signal = times_of(first.loss.signal, (first.bridge - intact) * means.bridge / means.weight);
  // A levelling may shift all heights by as much as the bridge settles.
  const VectorXd of_intact = intact * result.bridge_mean;
  const bool is_level_known = !observation.has_levelling();
  result.times_movement =
      times_of(bridge.movement, is_level_known ? VectorXd(of_intact + result.from_model) : of_intact);
}

BridgePosterior empty_posterior(const UnknownBridge& bridge) {
  const Index epochs = bridge.epochs * bridge.factors->of_epoch();
  BridgePosterior result;
  result.chance = result.square = 0.0;
  result.beside = result.others = result.spread = VectorXd::Zero(bridge.reading.size());
  result.from_unevenness = result.from_model = VectorXd::Zero(bridge.reading.size());
  result.signal = result.from_bridge = VectorXd::Zero(bridge.reading.size());
  result.from_epochs = MatrixXd::Zero(bridge.reading.size(), bridge.factors->epoch_parameters());
  result.bridge_mean = VectorXd::Zero(bridge.factors->of_bridge());
  result.epoch_mean = VectorXd::Zero(epochs);
  result.epoch_covariance = MatrixXd::Zero(epochs, epochs);
  return result;
}

}  // namespace

BridgePosterior bridge_posterior(const UnknownBridge& bridge, const Observation& observation,
                                 const SceneTable& table, const std::vector<WeightedScene>& scenes,
                                 std::span<const UnknownCase> cases) {
  BridgePosterior result = empty_posterior(bridge);
  const std::vector<Part> all = mixture_parts(bridge, observation, table, scenes, cases);
  for (const Part& part : all) result.scatter[part.kappa] += part.weight;
  const std::vector<Part> kept = heaviest(all);
  std::vector<std::optional<SceneGaussian>> gaussians(scenes.size());
  const auto gaussian = [&](std::size_t i) -> const SceneGaussian& {
    if (!gaussians[i]) gaussians[i] = scene_gaussian(bridge, observation, table, scenes[i].row);
    return *gaussians[i];
  };
  std::vector<SceneMeans> means(scenes.size(), {0.0, result.bridge_mean, result.epoch_mean});
  for (const Part& part : kept) {
    const CaseNoise noise = case_noise(bridge, observation, cases[part.in_case]);
    add_part(bridge, noise, gaussian(part.scene), kScatterFactors[part.kappa], part.weight, means[part.scene],
             result);
  }
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (means[i].weight == 0.0) continue;
    result.bridge_mean += means[i].bridge;
    result.epoch_mean += means[i].epoch;
    add_causes(bridge, gaussian(i), means[i], result);
  }
  result.epoch_covariance -= result.epoch_mean * result.epoch_mean.transpose();
  result.spread = (result.spread - result.beside.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  result.left = bridge.reading - result.signal - result.from_bridge - result.from_epochs.rowwise().sum() -
                result.from_unevenness;
  compare_with_model(bridge, observation, gaussian(0), means.front(), result);
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
