#include "lookup/evidence/sensor_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lookup/evidence/loss_gaussian.h"

namespace voussoir {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

/// What the chosen rows leave of covariance and signals, and the distances that they make.
struct LeftToSee {
  MatrixXd covariance;
  MatrixXd signals;  // rows x blocks
  ArrayXd square;    // of each block's distance

  ArrayXd square_with(Index row) const {
    return square + signals.row(row).transpose().array().square() / covariance(row, row);
  }

  void take(Index row) {
    square = square_with(row);
    const Eigen::VectorXd share = covariance.col(row) / covariance(row, row);
    const Eigen::RowVectorXd signal = signals.row(row), known = covariance.row(row);
    signals -= share * signal;
    covariance -= share * known;
  }
};

LeftToSee all_to_see(const UnknownBridge& bridge) {
  const std::vector<BlockId> blocks = blocks_with_sensitivities(bridge);
  LeftToSee left{loss_gaussian(bridge, std::nullopt).covariance,
                 MatrixXd(bridge.reading.size(), static_cast<Index>(blocks.size())),
                 ArrayXd::Zero(static_cast<Index>(blocks.size()))};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Eigen::VectorXd& signal = bridge.losses[static_cast<std::size_t>(value(blocks[b]))].signal;
    left.signals.col(static_cast<Index>(b)) = signal.array().isNaN().select(0.0, signal);
  }
  return left;
}

}  // namespace

std::vector<Index> rows_that_help(const UnknownBridge& bridge, double enough, std::size_t count) {
  LeftToSee left = all_to_see(bridge);
  std::vector<Index> candidates(static_cast<std::size_t>(left.signals.rows())), chosen;
  for (std::size_t k = 0; k < candidates.size(); ++k) candidates[k] = static_cast<Index>(k);
  while (chosen.size() < count && !candidates.empty()) {
    const auto best = std::ranges::max_element(
        candidates, {}, [&](Index row) { return left.square_with(row).sqrt().min(enough).sum(); });
    left.take(*best);
    chosen.push_back(*best);
    candidates.erase(best);
  }
  return chosen;
}

}  // namespace voussoir
