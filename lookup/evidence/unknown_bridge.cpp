#include "lookup/evidence/unknown_bridge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastDeviation = 1e-9;  // [m] of an instrument: what the database was solved to

/// The readings that there are. Of two epochs, where both count, first those of the first.
std::vector<ReadingRow> rows_of(const Comparison& comparison, const Observation& observation, Epochs epochs) {
  const bool change = is_change(comparison.kind);
  std::vector<std::size_t> channels;
  for (std::size_t i = 0; i < observation.reading.size(); ++i)
    if (!std::isnan(observation.reading[i])) channels.push_back(i);
  std::vector<ReadingRow> rows;
  if (change && epochs == Epochs::both && !comparison.before.empty())
    for (const std::size_t i : channels) rows.push_back({i, 1.0, 0.0});
  for (const std::size_t i : channels) rows.push_back({i, change ? -1.0 : 0.0, 1.0});
  return rows;
}

bool has_two_epochs(const std::vector<ReadingRow>& rows) {
  return rows.back().before != 0.0;
}

/// The first epoch's own readings stand before the changes.
bool has_first_epoch(const std::vector<ReadingRow>& rows) {
  return rows.front().after == 0.0;
}

/// Rows of y from a matrix whose rows are channels.
MatrixXd at_rows(const std::vector<ReadingRow>& rows, const MatrixXd& channels, double ReadingRow::*weight) {
  MatrixXd result(static_cast<Index>(rows.size()), channels.cols());
  for (std::size_t k = 0; k < rows.size(); ++k)
    result.row(static_cast<Index>(k)) = rows[k].*weight * channels.row(static_cast<Index>(rows[k].channel));
  return result;
}

/// What is the same in both epochs.
MatrixXd of_bridge(const std::vector<ReadingRow>& rows, const MatrixXd& channels) {
  return at_rows(rows, channels, &ReadingRow::before) + at_rows(rows, channels, &ReadingRow::after);
}

/// What each epoch has of its own: columns of the first, if it is in y, and of the second.
MatrixXd of_epochs(const std::vector<ReadingRow>& rows, const MatrixXd& channels) {
  const Index columns = channels.cols();
  MatrixXd result = MatrixXd::Zero(static_cast<Index>(rows.size()), (has_two_epochs(rows) ? 2 : 1) * columns);
  result.leftCols(columns) = at_rows(rows, channels, &ReadingRow::before);
  result.rightCols(columns) = at_rows(rows, channels, &ReadingRow::after);
  return result;
}

/// Variance of an instrument's error: of changes that of the difference of both epochs.
double instrument_variance(const Observation& observation, std::size_t channel, double level) {
  const double movement = std::abs(observation.reading[channel] - observation.origin[channel]);
  const double deviation =
      observation.share[channel] * level * (movement + kSmallestMovement) + observation.floor[channel];
  return std::max(deviation * deviation, kLeastDeviation * kLeastDeviation);
}

/// Each of two epochs has half the change's variance, and the first one's error is in the change.
void add_instruments(const std::vector<ReadingRow>& rows, const Observation& observation, double level,
                     MatrixXd& noise) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double variance = instrument_variance(observation, rows[k].channel, level);
    const auto at = static_cast<Index>(k);
    noise(at, at) += (rows[k].after == 0.0 ? 0.5 : 1.0) * variance;
    if (rows[k].after != 0.0) continue;
    const auto change = at + noise.rows() / 2;  // the same channels in the same order
    noise(at, change) -= 0.5 * variance;
    noise(change, at) -= 0.5 * variance;
  }
}

/// What is the same in all scenes. What the intact bridge has in both epochs cancels in changes.
MatrixXd common_noise(const Comparison& comparison, const Observation& observation, double level,
                      const UnknownBridge& bridge) {
  const std::vector<ReadingRow>& rows = bridge.rows;
  const auto n = static_cast<Index>(rows.size());
  MatrixXd noise = MatrixXd::Zero(n, n);
  add_instruments(rows, observation, level, noise);
  const std::vector<double>& own = comparison.model_error.intact;
  for (std::size_t k = 0; k < rows.size() && !own.empty(); ++k)
    noise(static_cast<Index>(k), static_cast<Index>(k)) +=
        std::pow((rows[k].before + rows[k].after) * own[rows[k].channel], 2);
  const FirstOrderResidual& residual = comparison.factors->residual;
  const double epochs = is_change(comparison.kind) ? std::numbers::sqrt2 : 1.0;  // that levellings stand for
  for (const MatrixXd& columns : {of_bridge(rows, residual.bridge), of_epochs(rows, residual.epoch),
                                  of_epochs(rows, observation.levelling / epochs)})
    noise.noalias() += columns * columns.transpose();
  return noise;
}

void add_readings(const Comparison& comparison, const Observation& observation, UnknownBridge& bridge) {
  const auto n = static_cast<Index>(bridge.rows.size());
  bridge.reading.resize(n);
  bridge.movement.resize(n);
  for (Index k = 0; k < n; ++k) {
    const auto& [channel, before, after] = bridge.rows[static_cast<std::size_t>(k)];
    const double intact = observation.intact[channel];
    const double shown = after == 0.0 ? comparison.before[channel] : observation.reading[channel];
    bridge.reading[k] = shown - intact;
    bridge.movement[k] = (before + after) * intact;
  }
}

void add_losses(const Comparison& comparison, const Observation& observation, UnknownBridge& bridge) {
  const ReadingFactors& factors = *comparison.factors;
  const SceneTable& table = comparison.library.table;
  bridge.blocks.resize(factors.change.size());
  std::map<Scene, const SceneFactors*> of_pair;
  for (const auto& [scene, change] : factors.pairs) of_pair[scene] = &change;
  for (std::size_t row = 0; row < table.rows; ++row) {
    const std::span<const std::int32_t> removed =
        table.removed.subspan(row * table.most_missing, table.most_missing);
    const auto missing = std::count_if(removed.begin(), removed.end(), [](auto id) { return id >= 0; });
    if (missing == 1) {
      const auto block = static_cast<std::size_t>(removed.front());
      bridge.blocks[block] =
          loss_of(comparison, observation, bridge.rows, row, factors.change[block], bridge.epochs);
    } else if (missing > 1 && of_pair.empty()) {
      break;  // few removed blocks come first
    } else if (const auto found = of_pair.find(table.scene(row)); found != of_pair.end()) {
      bridge.pairs.emplace_back(
          found->first, loss_of(comparison, observation, bridge.rows, row, *found->second, bridge.epochs));
    }
  }
  std::sort(bridge.pairs.begin(), bridge.pairs.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
}

}  // namespace

UnknownBridge unknown_bridge(const Comparison& comparison, const Observation& observation, double level,
                             double scale, Epochs epochs) {
  const SceneFactors& intact = comparison.factors->intact;
  UnknownBridge bridge;
  bridge.rows = rows_of(comparison, observation, epochs);
  bridge.epochs = has_two_epochs(bridge.rows) ? 2 : 1;
  bridge.scale = scale;
  add_readings(comparison, observation, bridge);
  bridge.intact = {of_bridge(bridge.rows, intact.bridge), of_epochs(bridge.rows, intact.epoch)};
  bridge.noise = common_noise(comparison, observation, level, bridge);
  add_losses(comparison, observation, bridge);
  bridge.spread = typical_spread(bridge.blocks);
  return bridge;
}

std::vector<const Loss*> known_losses(const UnknownBridge& bridge, const Scene& scene) {
  const auto own =
      std::lower_bound(bridge.pairs.begin(), bridge.pairs.end(), scene,
                       [](const auto& pair, const Scene& wanted) { return pair.first < wanted; });
  if (own != bridge.pairs.end() && own->first == scene) return {&own->second};
  std::vector<const Loss*> losses;
  for (const BlockId block : scene.removed)
    if (const Loss& loss = bridge.blocks[static_cast<std::size_t>(value(block))]; loss.known())
      losses.push_back(&loss);
  return losses;
}

std::optional<SceneGaussian> scene_gaussian(const UnknownBridge& bridge, const Observation& observation,
                                            const SceneTable& table, std::size_t row) {
  const VectorXd signal = signal_of(observation, bridge.rows, table.row(row));
  if (signal.hasNaN()) return std::nullopt;
  SceneGaussian scene{bridge.reading - signal, bridge.intact, VectorXd::Zero(signal.size()),
                      MatrixXd(signal.size(), 2)};
  VectorXd beyond = signal;
  for (const Loss* loss : known_losses(bridge, table.scene(row))) {
    scene.factors.bridge += loss->factors.bridge;
    scene.factors.epoch += loss->factors.epoch;
    scene.variance += loss->variance;
    beyond -= loss->signal;
  }
  const Index changed = has_first_epoch(bridge.rows) ? signal.size() / 2 : signal.size();
  const double alike = bridge.spread * bridge.spread * beyond.squaredNorm() / static_cast<double>(changed);
  for (Index k = 0; k < signal.size(); ++k)
    if (bridge.rows[static_cast<std::size_t>(k)].after != 0.0) scene.variance[k] += alike;
  scene.columns << bridge.spread * beyond, bridge.scale * (bridge.movement + signal);
  return scene;
}

MatrixXd SceneGaussian::covariance(const UnknownBridge& bridge, double kappa) const {
  MatrixXd result = bridge.noise + kappa * (factors.bridge * factors.bridge.transpose());
  result.noalias() += factors.epoch * factors.epoch.transpose();
  result.noalias() += columns * columns.transpose();
  result.diagonal() += variance;
  return result;
}

}  // namespace voussoir
