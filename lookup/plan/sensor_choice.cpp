#include "lookup/plan/sensor_choice.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/threads.h"
#include "lookup/plan/loss_gaussian.h"
#include "lookup/unknown/leading_directions.h"

namespace voussoir {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// In which a loss makes readings scatter more than those of the intact bridge: more of them change no chance
/// by a hundredth (docs/plan.md).
constexpr Index kWider = 8;

/// What decides whether a loss is seen: logs of likelihood ratios.
struct Odds {
  double wanted;     // that makes it certain, but for the loss's weight
  double of_silent;  // that each sensor adds which falls silent

  explicit Odds(const SightSettings& settings)
      : wanted(std::log(settings.certain / (1.0 - settings.certain)) + settings.log_prior_intact -
               settings.log_prior_loss),
        of_silent(-settings.log_silence) {}

  double chance(double divergence, Index silent, double log_weight) const {
    const double left = std::max(0.0, wanted - log_weight - static_cast<double>(silent) * of_silent);
    return std::exp(-left / std::max(divergence, std::numeric_limits<double>::min()));
  }
};

/// The Gaussian of a block's loss beside the intact bridge's: N(s, C + W W^T) in the rows that are not
/// silent. Kept is T = [s W], zero in the silent rows, by what the inverse K of C in the rows read makes of
/// it.
struct LossBesideIntact {
  std::vector<Index> silent;
  MatrixXd pulled;    // K T
  MatrixXd inner;     // T^T K T
  double log_weight;  // Loss::log_weight
};

/// [s W] of a loss.
MatrixXd columns_of(const LossGaussian& loss, const MatrixXd& covariance, const std::vector<Index>& read) {
  MatrixXd columns = MatrixXd::Zero(covariance.rows(), 1 + kWider);
  if (read.empty()) return columns;
  const Eigen::LLT<MatrixXd> white(MatrixXd(covariance(read, read)));
  MatrixXd wider = loss.covariance(read, read) - covariance(read, read);
  white.matrixL().solveInPlace(wider);
  wider.transposeInPlace();
  white.matrixL().solveInPlace(wider);
  const MatrixXd directions = leading_directions(wider, std::min(kWider, wider.rows()));
  const VectorXd variances = (directions.transpose() * wider * directions).diagonal().cwiseMax(0.0);
  const MatrixXd shown = white.matrixL() * directions * variances.cwiseSqrt().asDiagonal();
  for (std::size_t k = 0; k < read.size(); ++k) {
    columns(read[k], 0) = loss.signal[read[k]];
    columns.row(read[k]).segment(1, shown.cols()) = shown.row(static_cast<Index>(k));
  }
  return columns;
}

LossBesideIntact loss_beside_intact(const UnknownBridge& bridge, const CaseNoise& noise, BlockId block,
                                    const MatrixXd& covariance, const MatrixXd& precision) {
  const LossGaussian loss = loss_gaussian(bridge, noise, block);
  const std::vector<Index> read = rows_with_reading(loss.signal);
  const MatrixXd columns = columns_of(loss, covariance, read);
  LossBesideIntact result{{}, precision * columns, {}, bridge.loss_of(block).log_weight};
  result.inner = columns.transpose() * result.pulled;
  for (Index row = 0; row < loss.signal.size(); ++row)
    if (std::isnan(loss.signal[row])) result.silent.push_back(row);
  return result;
}

/// The rows that are still read, and the losses in them.
class ReadRows {
 public:
  ReadRows(const UnknownBridge& bridge, const CaseNoise& noise)
      : rows_(static_cast<std::size_t>(bridge.reading.size())) {
    std::iota(rows_.begin(), rows_.end(), Index{0});
    const MatrixXd covariance = loss_gaussian(bridge, noise, std::nullopt).covariance;
    precision_ = covariance.llt().solve(MatrixXd::Identity(covariance.rows(), covariance.cols()));
    const std::vector<BlockId> blocks = blocks_with_sensitivities(bridge);
    losses_.resize(blocks.size());
    for_each_index_on_threads(blocks.size(), hardware_threads(), [&](std::size_t b) {
      losses_[b] = loss_beside_intact(bridge, noise, blocks[b], covariance, precision_);
    });
  }

  const std::vector<Index>& rows() const { return rows_; }

  /// The row without which the sum of chances is largest.
  Index least_missed(const Odds& odds) const {
    MatrixXd chances(precision_.rows(), static_cast<Index>(losses_.size()));
    for_each_index_on_threads(losses_.size(), hardware_threads(), [&](std::size_t b) {
      chances.col(static_cast<Index>(b)) = chances_without(losses_[b], odds);
    });
    const VectorXd sums = chances.rowwise().sum();
    return *std::ranges::max_element(rows_, {}, [&](Index row) { return sums[row]; });
  }

  void leave_out(Index row) {
    const VectorXd share = precision_.col(row) / precision_(row, row);
    for (LossBesideIntact& loss : losses_) {
      const Eigen::RowVectorXd own = loss.pulled.row(row);
      loss.inner -= own.transpose() * own / precision_(row, row);
      loss.pulled -= share * own;
    }
    precision_ -= share * precision_.row(row).eval();
    std::erase(rows_, row);
  }

 private:
  /// The chances that a loss is seen without each of the rows.
  ArrayXd chances_without(const LossBesideIntact& loss, const Odds& odds) const {
    MatrixXd pulled = loss.pulled, inner = loss.inner;
    ArrayXd diagonal = precision_.diagonal();
    std::vector<Index> silent;
    std::ranges::set_intersection(loss.silent, rows_, std::back_inserter(silent));
    if (!silent.empty()) {  // what the precision is without them
      const Eigen::LLT<MatrixXd> factor(MatrixXd(precision_(silent, silent)));
      const MatrixXd shared = factor.matrixL().solve(MatrixXd(precision_(silent, Eigen::all)));
      const MatrixXd from = factor.matrixL().solve(MatrixXd(pulled(silent, Eigen::all)));
      pulled -= shared.transpose() * from;
      inner -= from.transpose() * from;
      diagonal -= shared.colwise().squaredNorm().transpose().array();
    }
    const Eigen::LLT<MatrixXd> wider(
        MatrixXd(MatrixXd::Identity(kWider, kWider) + inner.bottomRightCorner(kWider, kWider)));
    const double log_determinant = 2.0 * MatrixXd(wider.matrixLLT()).diagonal().array().log().sum();
    const double divergence = 0.5 * (inner.trace() - log_determinant);
    const MatrixXd within = wider.matrixL().solve(pulled.rightCols(kWider).transpose());
    ArrayXd chances = ArrayXd::Zero(diagonal.size());
    const auto count = static_cast<Index>(silent.size());
    for (const Index row : rows_) {
      if (std::ranges::binary_search(silent, row)) {
        chances[row] = odds.chance(divergence, count - 1, loss.log_weight);
        continue;
      }
      const double less = pulled.row(row).squaredNorm() / diagonal[row] +
                          std::log1p(-within.col(row).squaredNorm() / diagonal[row]);
      chances[row] = odds.chance(divergence - 0.5 * less, count, loss.log_weight);
    }
    return chances;
  }

  MatrixXd precision_;  // K, zero in rows that are not read
  std::vector<Index> rows_;
  std::vector<LossBesideIntact> losses_;
};

}  // namespace

std::vector<Index> rows_that_help(const UnknownBridge& bridge, const CaseNoise& noise,
                                  const SightSettings& settings, std::size_t count) {
  const Odds odds(settings);
  ReadRows read(bridge, noise);
  std::vector<Index> chosen;
  while (!read.rows().empty()) {
    const Index row = read.least_missed(odds);
    if (read.rows().size() <= count) chosen.push_back(row);
    read.leave_out(row);
  }
  std::ranges::reverse(chosen);
  return chosen;
}

}  // namespace voussoir
