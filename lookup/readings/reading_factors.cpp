#include "lookup/readings/reading_factors.h"

#include <algorithm>

#include "core/threads.h"
#include "lookup/readings/scene_change.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The channels' points of a scene's factors, column by column as they lie in memory.
MatrixXd rows_of(const MatrixXd& points, const std::vector<Channel>& channels) {
  MatrixXd rows(static_cast<Index>(channels.size()), points.cols());
  for (Index j = 0; j < rows.cols(); ++j)
    for (std::size_t i = 0; i < channels.size(); ++i)
      rows(static_cast<Index>(i), j) = points(static_cast<Index>(channels[i].point), j);
  return rows;
}

/// The scene's factors by channel; not known if they are unknown in one of the states.
SceneFactors factors_of(const ReadingFactors& factors, const Scene& scene) {
  const Sensitivities& from = *factors.sensitivities;
  const SceneFactors* const unloaded = from.find(factors.base, scene);
  if (unloaded == nullptr) return {};
  SceneFactors result{rows_of(unloaded->bridge, factors.channels),
                      rows_of(unloaded->epoch, factors.channels)};
  for (std::size_t k = 0; k < factors.channels.size(); ++k) {
    const Channel& channel = factors.channels[k];
    if (!channel.loaded) continue;
    const SceneFactors* const loaded = from.find(*channel.loaded, scene);
    if (loaded == nullptr) return {};
    const auto i = static_cast<Index>(k), point = static_cast<Index>(channel.point);
    result.bridge.row(i) = loaded->bridge.row(point) - result.bridge.row(i);
    result.epoch.row(i) = loaded->epoch.row(point) - result.epoch.row(i);
  }
  return result;
}

LossFactors loss_factors(const ReadingFactors& factors, const Scene& scene) {
  SceneFactors own = factors_of(factors, scene);
  if (!own.known()) return {};
  SceneFactors change = change_of(std::move(own), factors.intact);
  change.bridge *= widening(factors.residual.share, factors.residual.common);
  change.epoch *= widening(factors.residual.epoch_share, factors.residual.epoch_common);
  const Index lead = std::min(kLeadingColumns, change.bridge.cols());
  return {change.bridge.leftCols(lead), std::move(change.epoch),
          signal_factors(factors.intact.bridge, change.bridge)};
}

MatrixXd signal_product(const std::vector<LossFactors>& losses, Index channels) {
  MatrixXd sum = MatrixXd::Zero(channels, channels);
  for (const LossFactors& loss : losses) {
    if (!loss.known()) continue;
    const auto own = loss.signal.own.leftCols(std::min(kFirstOwnColumns, loss.signal.own.cols()));
    sum.noalias() += own * own.transpose();
  }
  return sum;
}

/// Of what a load adds the errors in both states count: nothing says how far they cancel.
FirstOrderResidual residual_of(const ReadingFactors& factors) {
  const auto& states = factors.sensitivities->states;
  FirstOrderResidual result = states[factors.base].residual;
  const auto both = [&](MatrixXd FirstOrderResidual::*columns) {
    const MatrixXd& unloaded = states[factors.base].residual.*columns;
    MatrixXd rows = MatrixXd::Zero(static_cast<Index>(factors.channels.size()), 2 * unloaded.cols());
    for (Index i = 0; i < rows.rows(); ++i) {
      const Channel& channel = factors.channels[static_cast<std::size_t>(i)];
      const auto point = static_cast<Index>(channel.point);
      rows.row(i).head(unloaded.cols()) = unloaded.row(point);
      if (channel.loaded)
        rows.row(i).tail(unloaded.cols()) = (states[*channel.loaded].residual.*columns).row(point);
    }
    return rows;
  };
  result.bridge = both(&FirstOrderResidual::bridge);
  result.epoch = both(&FirstOrderResidual::epoch);
  for (const Channel& channel : factors.channels)
    if (channel.loaded) {
      result.share = std::max(result.share, states[*channel.loaded].residual.share);
      result.common = std::max(result.common, states[*channel.loaded].residual.common);
      result.epoch_share = std::max(result.epoch_share, states[*channel.loaded].residual.epoch_share);
      result.epoch_common = std::max(result.epoch_common, states[*channel.loaded].residual.epoch_common);
    }
  return result;
}

}  // namespace

SceneFactors ReadingFactors::of(const Scene& scene) const {
  if (SceneFactors own = factors_of(*this, scene); own.known()) return own;
  SceneFactors sum = intact;
  for (const BlockId block : scene.removed)
    if (SceneFactors alone = factors_of(*this, {{block}}); alone.known()) {
      const SceneFactors change = change_of(std::move(alone), intact);
      sum.bridge += change.bridge;
      sum.epoch += change.epoch;
    }
  return sum;
}

std::shared_ptr<const ReadingFactors> reading_factors(const Sensitivities& sensitivities, std::size_t base,
                                                      std::vector<Channel> channels, std::size_t blocks) {
  ReadingFactors result{&sensitivities, base, std::move(channels), {}, {}, {}, {}, {}, {}};
  result.intact = factors_of(result, {});
  if (!result.intact.known()) return nullptr;
  result.intact_product = result.intact.bridge * result.intact.bridge.transpose();
  result.residual = residual_of(result);
  result.blocks.resize(blocks);
  for_each_index_on_threads(blocks, hardware_threads(), [&](std::size_t block) {
    result.blocks[block] = loss_factors(result, {{BlockId{static_cast<std::int32_t>(block)}}});
  });
  for (const Scene& scene : sensitivities.scenes)
    if (scene.missing() > 1)
      if (LossFactors own = loss_factors(result, scene); own.known())
        result.several.emplace_back(scene, std::move(own));
  std::ranges::sort(result.several, {}, &std::pair<Scene, LossFactors>::first);
  result.signal_product = signal_product(result.blocks, result.intact_product.rows());
  return std::make_shared<const ReadingFactors>(std::move(result));
}

}  // namespace voussoir
