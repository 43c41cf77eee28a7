#include "lookup/readings/reading_factors.h"

#include <algorithm>
#include <limits>

#include "core/threads.h"
#include "database/records/scene_change.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kAll = std::numeric_limits<Index>::max();  // columns

/// The channels' points of a matrix whose rows are points.
template <class Points>
MatrixXd rows_of(const Points& points, const std::vector<Channel>& channels) {
  MatrixXd rows(static_cast<Index>(channels.size()), points.cols());
  for (Index j = 0; j < rows.cols(); ++j)
    for (std::size_t i = 0; i < channels.size(); ++i)
      rows(static_cast<Index>(i), j) = points(static_cast<Index>(channels[i].point), j);
  return rows;
}

/// The scene's factors by channel, and of the basis the leading columns; not known if they are unknown in one
/// of the states.
SceneFactors factors_of(const ReadingFactors& factors, const Scene& scene, Index columns = kAll) {
  const Sensitivities& from = *factors.sensitivities;
  const auto unloaded = from.find(factors.base, scene, columns);
  if (!unloaded) return {};
  SceneFactors result{rows_of(unloaded->bridge, factors.channels),
                      rows_of(unloaded->epoch, factors.channels)};
  for (std::size_t k = 0; k < factors.channels.size(); ++k) {
    const Channel& channel = factors.channels[k];
    if (!channel.loaded) continue;
    const auto loaded = from.find(*channel.loaded, scene, columns);
    if (!loaded) return {};
    const auto i = static_cast<Index>(k), point = static_cast<Index>(channel.point);
    result.bridge.row(i) = loaded->bridge.row(point) - result.bridge.row(i);
    result.epoch.row(i) = loaded->epoch.row(point) - result.epoch.row(i);
  }
  return result;
}

/// Makes what losses change in the channels' factors.
class Losses {
 public:
  explicit Losses(const ReadingFactors& factors)
      : factors_(factors),
        of_bridge_(widening(factors.residual.share, factors.residual.common)),
        of_epoch_(widening(factors.residual.epoch_share, factors.residual.epoch_common)),
        lead_(std::min(kLeadingColumns, factors.of_bridge())),
        leading_intact_{factors.intact.bridge.leftCols(lead_), factors.intact.epoch} {
    const bool loaded =
        std::ranges::any_of(factors.channels, [](const Channel& c) { return c.loaded.has_value(); });
    if (!loaded && factors.sensitivities->signals) stored_ = &*factors.sensitivities->signals;
  }

  /// Not known if the scene's factors are not.
  LossFactors operator()(const Scene& scene) const {
    SceneFactors own = factors_of(factors_, scene, stored_ ? lead_ : kAll);
    if (!own.known()) return {};
    SceneFactors change = change_of(std::move(own), stored_ ? leading_intact_ : factors_.intact);
    change.bridge *= of_bridge_;
    change.epoch *= of_epoch_;
    if (stored_) return {std::move(change.bridge), std::move(change.epoch), stored_signal(scene)};
    return {change.bridge.leftCols(lead_), std::move(change.epoch),
            signal_factors(factors_.intact.bridge, change.bridge)};
  }

 private:
  /// Those of all points are those of some, but with more columns than some need.
  SignalFactors stored_signal(const Scene& scene) const {
    const auto stored = (*stored_)[factors_.sensitivities->place_of(factors_.base, scene).value()];
    SignalFactors signal{rows_of(stored.own, factors_.channels), rows_of(stored.intact, factors_.channels)};
    signal.own *= of_bridge_;
    if (signal.own.rows() < stored.own.rows()) return signal_factors(signal.intact, signal.own);
    return signal;
  }

  const ReadingFactors& factors_;
  double of_bridge_, of_epoch_;
  Index lead_;
  SceneFactors leading_intact_;
  const StoredSignals* stored_ = nullptr;  // where they are those of the channels
};

MatrixXd signal_product(const std::vector<LossFactors>& losses, Index channels) {
  Index columns = 0;
  const auto counted = [](const LossFactors& loss) {
    return loss.signal.own.leftCols(std::min(kFirstOwnColumns, loss.signal.own.cols()));
  };
  for (const LossFactors& loss : losses) columns += counted(loss).cols();
  MatrixXd all(channels, columns);
  for (columns = 0; const LossFactors& loss : losses) {
    if (!loss.known()) continue;
    all.middleCols(columns, counted(loss).cols()) = counted(loss);
    columns += counted(loss).cols();
  }
  return product_with_itself(all);
}

/// Of what a load adds the errors in both states count: nothing says how far they cancel.
FirstOrderResidual residual_of(const ReadingFactors& factors) {
  const std::vector<FirstOrderResidual>& states = factors.sensitivities->residuals;
  FirstOrderResidual result = states[factors.base];
  const auto both = [&](MatrixXd FirstOrderResidual::*columns) {
    const MatrixXd& unloaded = states[factors.base].*columns;
    MatrixXd rows = MatrixXd::Zero(static_cast<Index>(factors.channels.size()), 2 * unloaded.cols());
    for (Index i = 0; i < rows.rows(); ++i) {
      const Channel& channel = factors.channels[static_cast<std::size_t>(i)];
      const auto point = static_cast<Index>(channel.point);
      rows.row(i).head(unloaded.cols()) = unloaded.row(point);
      if (channel.loaded) rows.row(i).tail(unloaded.cols()) = (states[*channel.loaded].*columns).row(point);
    }
    return rows;
  };
  result.bridge = both(&FirstOrderResidual::bridge);
  result.epoch = both(&FirstOrderResidual::epoch);
  for (const Channel& channel : factors.channels)
    if (channel.loaded) {
      result.share = std::max(result.share, states[*channel.loaded].share);
      result.common = std::max(result.common, states[*channel.loaded].common);
      result.epoch_share = std::max(result.epoch_share, states[*channel.loaded].epoch_share);
      result.epoch_common = std::max(result.epoch_common, states[*channel.loaded].epoch_common);
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
  result.intact_product = product_with_itself(result.intact.bridge);
  result.residual = residual_of(result);
  result.blocks.resize(blocks);
  const Losses losses(result);
  for_each_index_on_threads(blocks, hardware_threads(), [&](std::size_t block) {
    result.blocks[block] = losses({{BlockId{static_cast<std::int32_t>(block)}}});
  });
  for (const Scene& scene : sensitivities.scenes)
    if (scene.missing() > 1)
      if (LossFactors own = losses(scene); own.known()) result.several.emplace_back(scene, std::move(own));
  std::ranges::sort(result.several, {}, &std::pair<Scene, LossFactors>::first);
  result.signal_product = signal_product(result.blocks, result.intact_product.rows());
  return std::make_shared<const ReadingFactors>(std::move(result));
}

}  // namespace voussoir
