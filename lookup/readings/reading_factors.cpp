#include "lookup/readings/reading_factors.h"

#include <algorithm>

namespace voussoir {
namespace {

using Eigen::MatrixXd;

/// Rows of channels from rows of points in the states that the channels compare.
class ChannelRows {
 public:
  ChannelRows(const Sensitivities& sensitivities, std::size_t base, const std::vector<Channel>& channels)
      : sensitivities_(sensitivities), base_(base), channels_(channels) {}

  /// Not known if the scene's are unknown in one of the states.
  SceneFactors of(const Scene& scene) const {
    const SceneFactors* const unloaded = sensitivities_.find(base_, scene);
    if (unloaded == nullptr) return {};
    SceneFactors result{empty(unloaded->bridge), empty(unloaded->epoch)};
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const Channel& channel = channels_[i];
      const auto to = static_cast<Eigen::Index>(i), from = static_cast<Eigen::Index>(channel.point);
      const SceneFactors* const loaded =
          channel.loaded ? sensitivities_.find(*channel.loaded, scene) : nullptr;
      if (channel.loaded && loaded == nullptr) return {};
      const double sign = channel.loaded ? -1.0 : 1.0;
      result.bridge.row(to) = sign * unloaded->bridge.row(from);
      result.epoch.row(to) = sign * unloaded->epoch.row(from);
      if (loaded == nullptr) continue;
      result.bridge.row(to) += loaded->bridge.row(from);
      result.epoch.row(to) += loaded->epoch.row(from);
    }
    return result;
  }

  /// Of what a load adds the errors in both states count: nothing says how far they cancel.
  FirstOrderResidual residual() const {
    FirstOrderResidual result = sensitivities_.states[base_].residual;
    for (const Channel& channel : channels_)
      if (channel.loaded) {
        const FirstOrderResidual& loaded = sensitivities_.states[*channel.loaded].residual;
        result.share = std::max(result.share, loaded.share);
        result.common = std::max(result.common, loaded.common);
      }
    result.bridge = both(&FirstOrderResidual::bridge);
    result.epoch = both(&FirstOrderResidual::epoch);
    return result;
  }

 private:
  MatrixXd empty(const MatrixXd& like) const {
    return MatrixXd::Zero(static_cast<Eigen::Index>(channels_.size()), like.cols());
  }

  MatrixXd both(MatrixXd FirstOrderResidual::*columns) const {
    const MatrixXd& unloaded = sensitivities_.states[base_].residual.*columns;
    MatrixXd result = MatrixXd::Zero(static_cast<Eigen::Index>(channels_.size()), 2 * unloaded.cols());
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const Channel& channel = channels_[i];
      const auto to = static_cast<Eigen::Index>(i), from = static_cast<Eigen::Index>(channel.point);
      result.row(to).head(unloaded.cols()) = unloaded.row(from);
      if (channel.loaded)
        result.row(to).tail(unloaded.cols()) =
            (sensitivities_.states[*channel.loaded].residual.*columns).row(from);
    }
    return result;
  }

  const Sensitivities& sensitivities_;
  std::size_t base_;
  const std::vector<Channel>& channels_;
};

/// Where a block is gone (rows are zero) nothing is read and nothing changes.
SceneFactors less(SceneFactors factors, const SceneFactors& intact) {
  for (Eigen::Index i = 0; i < factors.bridge.rows(); ++i) {
    if (factors.bridge.row(i).isZero(0.0) && factors.epoch.row(i).isZero(0.0)) continue;
    factors.bridge.row(i) -= intact.bridge.row(i);
    factors.epoch.row(i) -= intact.epoch.row(i);
  }
  return factors;
}

}  // namespace

std::shared_ptr<const ReadingFactors> reading_factors(const Sensitivities& sensitivities, std::size_t base,
                                                      const std::vector<Channel>& channels,
                                                      std::size_t blocks) {
  const ChannelRows rows(sensitivities, base, channels);
  ReadingFactors result{sensitivities.parameters, sensitivities.basis, rows.of({}), {}, {}, rows.residual()};
  if (!result.intact.known()) return nullptr;
  for (std::size_t block = 0; block < blocks; ++block)
    result.change.push_back(less(rows.of({{BlockId{static_cast<std::int32_t>(block)}}}), result.intact));
  for (const Scene& scene : sensitivities.scenes)
    if (scene.missing() > 1)
      if (SceneFactors own = rows.of(scene); own.known())
        result.pairs.emplace_back(scene, less(std::move(own), result.intact));
  return std::make_shared<const ReadingFactors>(std::move(result));
}

}  // namespace voussoir
