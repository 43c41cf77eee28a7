#include "lookup/plan/loss_gaussian.h"

#include <cmath>

namespace voussoir {

LossGaussian loss_gaussian(const UnknownBridge& bridge, const CaseNoise& noise, std::optional<BlockId> lost) {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(bridge.reading.size());
  SceneLoss loss{{}, nothing, nothing, 0.0};
  Scene scene;
  if (lost) {
    loss.known = {&bridge.loss_of(*lost)};
    loss.signal = loss.known.front()->signal;
    scene.removed = {*lost};
  }
  const Eigen::MatrixXd columns = bridge_columns(bridge, scene);
  return {loss.signal, scene_noise(bridge, noise, loss) + columns * columns.transpose()};
}

std::vector<BlockId> blocks_with_sensitivities(const UnknownBridge& bridge) {
  std::vector<BlockId> blocks;
  for (std::size_t b = 0; b < bridge.blocks; ++b)
    if (bridge.losses[b].known()) blocks.push_back(BlockId{static_cast<std::int32_t>(b)});
  return blocks;
}

std::vector<Eigen::Index> rows_with_reading(const Eigen::VectorXd& signal) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = 0; k < signal.size(); ++k)
    if (!std::isnan(signal[k])) rows.push_back(k);
  return rows;
}

}  // namespace voussoir
