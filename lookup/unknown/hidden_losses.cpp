#include "lookup/unknown/hidden_losses.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of y that a loss leaves no value.
struct LossRows {
  std::vector<Index> lost;
  VectorXd signal;  // [m] zero in the lost rows
};

LossRows rows_of_loss(const UnknownBridge& bridge, const Observation& observation,
                      std::span<const double> prediction) {
  LossRows result{{}, VectorXd::Zero(bridge.reading.size())};
  for (Index k = 0; k < result.signal.size(); ++k) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
    const double moved = prediction[row.channel] - observation.intact[row.channel];
    if (std::isnan(moved))
      result.lost.push_back(k);
    else
      result.signal[k] = row.after * moved;
  }
  return result;
}

/// Densities of the readings but the lost ones.
struct WithoutRows {
  double intact = kImpossible;
  double loss = kImpossible;
};

/// The covariance of what is left has the inverse K_rr - K_ri K_ii^-1 K_ir and, but for a constant, the
/// determinant |C| |K_ii|.
WithoutRows without_rows(const IntactGaussian& intact, const LossRows& loss) {
  const Eigen::LLT<MatrixXd> own(MatrixXd(intact.precision(loss.lost, loss.lost)));
  const VectorXd pulled = intact.pulled(loss.lost);
  const VectorXd answer = own.solve(pulled);
  const VectorXd shared = intact.precision(loss.lost, Eigen::all) * loss.signal;
  const double log_root = own.matrixLLT().diagonal().array().log().sum();
  const double along = loss.signal.dot(intact.pulled) - shared.dot(answer);
  const double square =
      loss.signal.dot(intact.precision * loss.signal) - shared.dot(VectorXd(own.solve(shared)));
  WithoutRows result;
  result.intact = intact.log + 0.5 * pulled.dot(answer) - log_root;
  result.loss = result.intact + (along > 0.0 && square > 0.0 ? 0.5 * along * along / square : 0.0);
  return result;
}

}  // namespace

std::vector<HiddenLoss> hidden_losses(const UnknownBridge& bridge, const Observation& observation,
                                      const Library& library, const Eligible& eligible,
                                      std::span<const IntactGaussian> gaussians) {
  const SceneTable& table = library.table;
  std::vector<HiddenLoss> result;
  for (std::size_t i = 0; i < eligible.rows.size(); ++i) {
    if (eligible.missing[i] != 1) continue;
    const LossRows loss = rows_of_loss(bridge, observation, table.row(eligible.rows[i]));
    const BlockId block = table.scene(eligible.rows[i]).removed.front();
    const bool on_block_alone = std::ranges::all_of(loss.lost, [&](Index k) {
      return library.points[bridge.rows[static_cast<std::size_t>(k)].channel].is_on(block);
    });
    if (loss.lost.empty() || !on_block_alone || loss.signal.isZero(0.0)) continue;
    WithoutRows best;
    for (const IntactGaussian& intact : gaussians) {
      const WithoutRows found = without_rows(intact, loss);
      best = {std::max(best.intact, found.intact), std::max(best.loss, found.loss)};
    }
    HiddenLoss hidden{eligible.rows[i], {}, best.loss - best.intact};
    for (const Index k : loss.lost) {
      const std::size_t channel = bridge.rows[static_cast<std::size_t>(k)].channel;
      if (std::ranges::find(hidden.channels, channel) == hidden.channels.end())
        hidden.channels.push_back(channel);
    }
    result.push_back(std::move(hidden));
  }
  std::ranges::stable_sort(result, std::ranges::greater{}, &HiddenLoss::gain);
  return result;
}

}  // namespace voussoir
