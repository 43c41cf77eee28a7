#include "lookup/unknown/unknown_bridge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/threads.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The readings that there are. Of two epochs, where both count, first those of the first.
std::vector<ReadingRow> rows_of(const Comparison& comparison, const Observation& observation, Epochs epochs) {
  const bool change = is_change(comparison.kind);
  const std::vector<std::size_t> channels = observation.channels_read();
  std::vector<ReadingRow> rows;
  if (change && epochs == Epochs::both && !comparison.before.empty())
    for (const std::size_t i : channels) rows.push_back({i, 1.0, 0.0});
  for (const std::size_t i : channels) rows.push_back({i, change ? -1.0 : 0.0, 1.0});
  return rows;
}

/// What each epoch has of its own: columns of the first, if it is in y, and of the second.
MatrixXd of_epochs(const std::vector<ReadingRow>& rows, Index epochs, const MatrixXd& before,
                   const MatrixXd& after) {
  const Index columns = after.cols();
  MatrixXd result = MatrixXd::Zero(static_cast<Index>(rows.size()), epochs * columns);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto channel = static_cast<Index>(rows[k].channel);
    auto to = result.row(static_cast<Index>(k));
    if (epochs > 1) to.head(columns) = rows[k].before * before.row(channel);
    to.tail(columns) += rows[k].after * after.row(channel);
  }
  return result;
}

/// Of joints that soften and blocks that warm unevenly in each epoch, however little is warmed and moved:
/// where the size of conditions was that of unevenness, too, 5 % in one third of a bridge was damage to it,
/// as nothing else had changed. Of the intact bridge for all scenes.
MatrixXd unevenness_of(const std::vector<ReadingRow>& rows, const MatrixXd& of_channels) {
  MatrixXd result(static_cast<Index>(rows.size()), static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t l = 0; l < rows.size(); ++l)
      result(static_cast<Index>(k), static_cast<Index>(l)) =
          (rows[k].before * rows[l].before + rows[k].after * rows[l].after) *
          of_channels(static_cast<Index>(rows[k].channel), static_cast<Index>(rows[l].channel));
  return result;
}

/// What is the same in all scenes and cases. What the intact bridge has in both epochs cancels in changes.
void add_noise(const Comparison& comparison, const Observation& observation, UnknownBridge& bridge) {
  const std::vector<ReadingRow>& rows = bridge.rows;
  const auto n = static_cast<Index>(rows.size());
  bridge.fixed_noise = MatrixXd::Zero(n, n);
  const std::vector<double>& own = comparison.model_error.intact;
  for (std::size_t k = 0; k < rows.size() && !own.empty(); ++k)
    bridge.fixed_noise(static_cast<Index>(k), static_cast<Index>(k)) +=
        std::pow(rows[k].of_bridge() * own[rows[k].channel], 2);
  const FirstOrderResidual& residual = comparison.factors->residual;
  // Levelling columns of changes stand for both epochs.
  const MatrixXd levelling = is_change(comparison.kind)
                                 ? MatrixXd(observation.levelling / std::numbers::sqrt2)
                                 : observation.levelling;
  const MatrixXd of_bridge = in_rows(rows, residual.bridge, residual.bridge);
  if (!of_bridge.isZero(0.0)) bridge.fixed_noise.noalias() += of_bridge * of_bridge.transpose();
  const MatrixXd level = of_epochs(rows, bridge.epochs, levelling, levelling);
  bridge.fixed_noise.noalias() += level * level.transpose();
  bridge.unevenness = unevenness_of(rows, comparison.factors->unevenness);
  bridge.fixed_noise += bridge.unevenness;
  const MatrixXd epoch = of_epochs(rows, bridge.epochs, residual.epoch, residual.epoch);
  bridge.epoch_noise = epoch * epoch.transpose();
}

void add_readings(const Comparison& comparison, const Observation& observation, UnknownBridge& bridge) {
  const auto n = static_cast<Index>(bridge.rows.size());
  bridge.reading.resize(n);
  bridge.movement.resize(n);
  for (Index k = 0; k < n; ++k) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
    const double intact = observation.intact[row.channel];
    const double shown = row.after == 0.0 ? comparison.before[row.channel] : observation.reading[row.channel];
    bridge.reading[k] = shown - intact;
    bridge.movement[k] = row.of_bridge() * intact;
  }
}

VectorXd signal_of(const UnknownBridge& bridge, const Observation& observation,
                   std::span<const double> prediction) {
  VectorXd signal(static_cast<Index>(bridge.rows.size()));
  for (std::size_t k = 0; k < bridge.rows.size(); ++k) {
    const ReadingRow& row = bridge.rows[k];
    signal[static_cast<Index>(k)] =
        row.after == 0.0 ? 0.0 : row.after * (prediction[row.channel] - observation.intact[row.channel]);
  }
  return signal;
}

/// Column by column, as they lie in memory.
VectorXd squares_of_rows(const MatrixXd& matrix) {
  VectorXd sums = VectorXd::Zero(matrix.rows());
  for (Index j = 0; j < matrix.cols(); ++j) sums += matrix.col(j).cwiseAbs2();
  return sums;
}

/// The loss of what stands in a row of the table.
Loss loss_of(const UnknownBridge& bridge, const Observation& observation, const LossFactors& factors,
             std::span<const double> prediction) {
  Loss loss{factors.known() ? &factors : nullptr, signal_of(bridge, observation, prediction)};
  if (!loss.known()) return loss;
  const VectorXd of_bridge = squares_of_rows(factors.own.leading(kFirstOwnColumns));
  const VectorXd of_epoch = squares_of_rows(factors.epoch);
  for (const ReadingRow& row : bridge.rows) {
    const auto channel = static_cast<Index>(row.channel);
    loss.bridge_variance += row.after * row.after * of_bridge[channel];
    loss.epoch_variance += row.after * row.after * of_epoch[channel];
  }
  return loss;
}

void add_losses(const Comparison& comparison, const Observation& observation, UnknownBridge& bridge) {
  const ReadingFactors& factors = *comparison.factors;
  const SceneTable& table = comparison.library.table;
  bridge.blocks = factors.blocks.size();
  bridge.losses.resize(bridge.blocks);
  for_each_index_on_threads(bridge.blocks, hardware_threads(), [&](std::size_t block) {
    const auto row = table.find({{BlockId{static_cast<std::int32_t>(block)}}});
    if (!row) return;
    Loss& loss = bridge.losses[block];
    loss = loss_of(bridge, observation, factors.blocks[block], table.row(*row));
    loss.may_fall = table.is_uncertain_fall(*row);
    loss.log_weight = table.log_weight(*row);
  });
  for (const auto& [scene, change] : factors.several)
    if (const auto row = table.find(scene)) {
      bridge.several.push_back(scene);
      bridge.losses.push_back(loss_of(bridge, observation, change, table.row(*row)));
    }
}

}  // namespace

UnknownBridge unknown_bridge(const Comparison& comparison, const Observation& observation,
                             const UnknownSettings& settings) {
  UnknownBridge bridge;
  bridge.factors = comparison.factors.get();
  bridge.rows = rows_of(comparison, observation, settings.epochs);
  bridge.epochs = bridge.rows.back().before != 0.0 ? 2 : 1;
  bridge.conditions = settings.conditions;
  bridge.scale = settings.scale;
  bridge.model_error = std::hypot(observation.error_share, observation.error_common);
  add_readings(comparison, observation, bridge);
  add_noise(comparison, observation, bridge);
  add_losses(comparison, observation, bridge);
  return bridge;
}

/// Column by column, as they lie in memory.
MatrixXd in_rows(const std::vector<ReadingRow>& rows, const MatrixXd& before, const MatrixXd& after) {
  MatrixXd result(static_cast<Index>(rows.size()), after.cols());
  for (Index j = 0; j < after.cols(); ++j)
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto channel = static_cast<Index>(rows[k].channel);
      result(static_cast<Index>(k), j) =
          rows[k].before * before(channel, j) + rows[k].after * after(channel, j);
    }
  return result;
}

MatrixXd product_in_rows(const std::vector<ReadingRow>& rows, const MatrixXd& by_channel,
                         double (*weight)(const ReadingRow&)) {
  VectorXd weights(static_cast<Index>(rows.size()));
  std::vector<Index> channels;
  for (const ReadingRow& row : rows) {
    weights[static_cast<Index>(channels.size())] = weight(row);
    channels.push_back(static_cast<Index>(row.channel));
  }
  return (weights * weights.transpose()).cwiseProduct(by_channel(channels, channels));
}

std::optional<std::size_t> place_of_several(const UnknownBridge& bridge, const Scene& scene) {
  const auto own = std::lower_bound(bridge.several.begin(), bridge.several.end(), scene);
  if (own == bridge.several.end() || *own != scene) return std::nullopt;
  return bridge.blocks + static_cast<std::size_t>(own - bridge.several.begin());
}

std::optional<SceneLoss> scene_loss(const UnknownBridge& bridge, const Observation& observation,
                                    const SceneTable& table, std::size_t row) {
  SceneLoss loss;
  loss.signal = signal_of(bridge, observation, table.row(row));
  if (loss.signal.hasNaN()) return std::nullopt;
  const KnownLosses known = known_losses(bridge, table, row);
  for (std::size_t i = 0; i < known.count; ++i) loss.known.push_back(&bridge.losses[known.place[i]]);
  loss.beyond = loss.signal;
  for (const Loss* one : loss.known) loss.beyond -= one->signal;
  const Index changed = bridge.has_first_epoch() ? loss.signal.size() / 2 : loss.signal.size();
  if (!known.all) loss.square_at_points = loss.beyond.squaredNorm() / static_cast<double>(changed);
  return loss;
}

MatrixXd intact_product(const UnknownBridge& bridge) {
  return product_in_rows(bridge.rows, bridge.factors->intact_product,
                         [](const ReadingRow& row) { return row.of_bridge(); });
}

MatrixXd bridge_columns(const UnknownBridge& bridge, const Scene& scene) {
  return in_rows(bridge.rows, bridge.factors->intact.bridge, bridge.factors->of(scene).bridge);
}

MatrixXd epoch_columns(const UnknownBridge& bridge, const SceneLoss& loss) {
  const MatrixXd& intact = bridge.factors->intact.epoch;
  MatrixXd after = intact;
  for (const Loss* one : loss.known) after += one->factors->epoch;
  return of_epochs(bridge.rows, bridge.epochs, intact, after);
}

MatrixXd other_columns(const UnknownBridge& bridge, const SceneLoss& loss) {
  MatrixXd columns = MatrixXd::Zero(loss.signal.size(), 1 + static_cast<Index>(loss.known.size()));
  columns.col(0) = bridge.scale * (bridge.movement + loss.signal);
  for (std::size_t i = 0; i < loss.known.size(); ++i)
    columns.col(1 + static_cast<Index>(i)) = bridge.model_error * loss.known[i]->signal;
  return columns;
}

}  // namespace voussoir
