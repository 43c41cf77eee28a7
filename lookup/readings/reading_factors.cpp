#include "lookup/readings/reading_factors.h"

#include <algorithm>
#include <functional>

#include "core/threads.h"
#include "database/records/scene_change.h"
#include "database/records/signal_factors.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Rows, by channel, of matrices whose rows are points.
std::vector<Index> points_of(const std::vector<Channel>& channels) {
  std::vector<Index> points;
  for (const Channel& channel : channels) points.push_back(static_cast<Index>(channel.point));
  return points;
}

/// Columns of an epoch: those of its parameters at these points, and what they leave.
MatrixXd with_left(MatrixXd epoch, const StackedMatrices::View& left, const std::vector<Index>& points) {
  epoch.conservativeResize(Eigen::NoChange, epoch.cols() + left.cols());
  if (left.cols() > 0) epoch.rightCols(left.cols()) = left(points, Eigen::all);
  return epoch;
}

MatrixXd epoch_of(const FactorsView& from, const std::vector<Index>& points) {
  return with_left(from.epoch(points, Eigen::all), from.left, points);
}

/// The scene's factors by channel; not known if they are unknown in one of the states.
SceneFactors factors_of(const ReadingFactors& factors, const Scene& scene) {
  const Sensitivities& from = *factors.sensitivities;
  const auto unloaded = from.find(factors.base, scene);
  if (!unloaded) return {};
  const std::vector<Index> points = points_of(factors.channels);
  SceneFactors result{unloaded->bridge(points, Eigen::all), epoch_of(*unloaded, points)};
  for (std::size_t k = 0; k < factors.channels.size(); ++k) {
    const Channel& channel = factors.channels[k];
    if (!channel.loaded) continue;
    const auto loaded = from.find(*channel.loaded, scene);
    if (!loaded) return {};
    const auto i = static_cast<Index>(k);
    const Index point = points[k];
    result.bridge.row(i) = loaded->bridge.row(point) - result.bridge.row(i);
    result.epoch.row(i) = epoch_of(*loaded, {point}) - result.epoch.row(i);
  }
  return result;
}

/// What a loss changes of an epoch's columns, widened where no sampled bridges show what is left.
void widen_epoch(const ReadingFactors& factors, MatrixXd& change) {
  const Index parameters = factors.epoch_parameters();
  change.leftCols(parameters) *=
      widening_of_epoch(factors.residual, change.rightCols(change.cols() - parameters));
}

/// What losses change in the channels' factors.
class Losses {
 public:
  explicit Losses(const ReadingFactors& factors)
      : factors_(factors), of_bridge_(widening(factors.residual.share, factors.residual.common)) {
    const bool loaded =
        std::ranges::any_of(factors.channels, [](const Channel& c) { return c.loaded.has_value(); });
    if (loaded || !factors.sensitivities->signals) return;
    stored_ = &*factors.sensitivities->signals;
    points_ = std::make_shared<const std::vector<Index>>(points_of(factors.channels));
  }

  /// Not known if the scene's factors are not.
  LossFactors operator()(const Scene& scene) const { return stored_ ? stored(scene) : made(scene); }

 private:
  LossFactors stored(const Scene& scene) const {
    const auto place = factors_.sensitivities->place_of(factors_.base, scene);
    if (!place) return {};
    const StoredSignals::Columns loss = (*stored_)[*place];
    MatrixXd epoch = with_left(ChannelColumns(loss.epoch, points_, 1.0).all(),
                               factors_.sensitivities->left[*place], *points_);
    widen_epoch(factors_, epoch);
    return {std::move(epoch),
            {loss.lead, points_, of_bridge_},
            {loss.own, points_, of_bridge_},
            {loss.intact, points_, 1.0}};
  }

  LossFactors made(const Scene& scene) const {
    SceneFactors own = factors_of(factors_, scene);
    if (!own.known()) return {};
    SceneFactors change = change_of(std::move(own), factors_.intact);
    change.bridge *= of_bridge_;
    widen_epoch(factors_, change.epoch);
    SignalFactors signal = signal_factors(factors_.intact.bridge, change.bridge);
    return {std::move(change.epoch),
            ChannelColumns(change.bridge.leftCols(factors_.sensitivities->leading_columns())),
            ChannelColumns(std::move(signal.own)), ChannelColumns(std::move(signal.intact))};
  }

  const ReadingFactors& factors_;
  double of_bridge_;
  const StoredSignals* stored_ = nullptr;  // where they are those of the channels
  std::shared_ptr<const std::vector<Index>> points_;
};

MatrixXd signal_product(const std::vector<LossFactors>& losses, Index channels) {
  MatrixXd all(channels, static_cast<Index>(losses.size()) * kFirstOwnColumns);
  Index end = 0;
  for (const LossFactors& loss : losses) {
    const MatrixXd first = loss.own.leading(kFirstOwnColumns);
    if (!loss.known()) continue;
    all.middleCols(end, first.cols()) = first;
    end += first.cols();
  }
  return product_with_itself(all.leftCols(end));
}

/// Columns that are the same in all states, by channel: of what a load adds those under it less those
/// without.
MatrixXd columns_of(const ReadingFactors& factors,
                    const std::function<const MatrixXd&(std::size_t)>& of_state) {
  const MatrixXd& base = of_state(factors.base);
  MatrixXd columns(static_cast<Index>(factors.channels.size()), base.cols());
  for (Index i = 0; i < columns.rows(); ++i) {
    const Channel& channel = factors.channels[static_cast<std::size_t>(i)];
    const auto point = static_cast<Index>(channel.point);
    columns.row(i) = base.row(point);
    if (channel.loaded) columns.row(i) = of_state(*channel.loaded).row(point) - base.row(point);
  }
  return columns;
}

/// The larger shares of both.
void take_larger(const FirstOrderResidual& other, FirstOrderResidual& shares) {
  for (double FirstOrderResidual::*share :
       {&FirstOrderResidual::share, &FirstOrderResidual::common, &FirstOrderResidual::epoch_share,
        &FirstOrderResidual::epoch_common})
    shares.*share = std::max(shares.*share, other.*share);
}

FirstOrderResidual residual_of(const ReadingFactors& factors) {
  const std::vector<FirstOrderResidual>& states = factors.sensitivities->residuals;
  FirstOrderResidual result{
      columns_of(factors, [&](std::size_t state) -> const MatrixXd& { return states[state].bridge; }),
      columns_of(factors, [&](std::size_t state) -> const MatrixXd& { return states[state].epoch; })};
  take_larger(states[factors.base], result);
  for (const Channel& channel : factors.channels)
    if (channel.loaded) take_larger(states[*channel.loaded], result);
  return result;
}

MatrixXd unevenness_of(const ReadingFactors& factors) {
  const std::vector<MatrixXd>& states = factors.sensitivities->unevenness;
  const auto channels = static_cast<Index>(factors.channels.size());
  if (states.empty()) return MatrixXd::Zero(channels, channels);
  return product_with_itself(
      columns_of(factors, [&](std::size_t state) -> const MatrixXd& { return states[state]; }));
}

}  // namespace

SceneFactors ReadingFactors::of(const Scene& scene) const {
  SceneFactors sum = intact;
  const auto add = [&](SceneFactors lost) {
    SceneFactors change = change_of(std::move(lost), intact);
    widen_epoch(*this, change.epoch);
    sum.bridge += widening(residual.share, residual.common) * change.bridge;
    sum.epoch += change.epoch;
  };
  if (SceneFactors own = factors_of(*this, scene); own.known()) {
    add(std::move(own));
    return sum;
  }
  for (const BlockId block : scene.removed)
    if (SceneFactors alone = factors_of(*this, {{block}}); alone.known()) add(std::move(alone));
  return sum;
}

std::shared_ptr<const ReadingFactors> reading_factors(const Sensitivities& sensitivities, std::size_t base,
                                                      std::vector<Channel> channels, std::size_t blocks) {
  ReadingFactors result{&sensitivities, base, std::move(channels), {}, {}, {}, {}, {}, {}, {}};
  result.intact = factors_of(result, {});
  if (!result.intact.known()) return nullptr;
  result.intact_product = product_with_itself(result.intact.bridge);
  result.residual = residual_of(result);
  result.unevenness = unevenness_of(result);
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
