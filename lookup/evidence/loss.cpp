#include "lookup/evidence/loss.h"

#include <algorithm>
#include <cmath>

#include "lookup/readings/common_variance.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Variance that parameters give each channel.
VectorXd spread_of(const SceneFactors& change) {
  return change.bridge.rowwise().squaredNorm() + change.epoch.rowwise().squaredNorm();
}

double finite_size(const VectorXd& signal) {
  return signal.array().isNaN().select(0.0, signal).norm();
}

}  // namespace

VectorXd signal_of(const Observation& observation, const std::vector<ReadingRow>& rows,
                   std::span<const double> prediction) {
  VectorXd signal(static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ReadingRow& row = rows[k];
    signal[static_cast<Index>(k)] =
        row.after == 0.0 ? 0.0 : row.after * (prediction[row.channel] - observation.intact[row.channel]);
  }
  return signal;
}

Loss loss_of(const Comparison& comparison, const Observation& observation,
             const std::vector<ReadingRow>& rows, std::size_t row, const SceneFactors& change, Index epochs) {
  const std::span<const double> prediction = comparison.library.table.row(row);
  const FirstOrderResidual& residual = comparison.factors->residual;
  const auto n = static_cast<Index>(rows.size());
  Loss loss{{}, signal_of(observation, rows, prediction), {}};
  const double common = common_variance(observation.intact, observation.error_common, prediction);
  loss.variance = (observation.error_share * loss.signal).array().square() + common;
  if (change.known()) {
    const VectorXd spread = spread_of(change);
    const double alike = residual.common * residual.common * spread.mean();
    loss.factors = {Eigen::MatrixXd(n, change.bridge.cols()),
                    Eigen::MatrixXd::Zero(n, epochs * change.epoch.cols())};
    for (Index k = 0; k < n; ++k) {
      const auto& [channel, before, after] = rows[static_cast<std::size_t>(k)];
      const auto from = static_cast<Index>(channel);
      loss.factors.bridge.row(k) = after * change.bridge.row(from);
      loss.factors.epoch.row(k).tail(change.epoch.cols()) = after * change.epoch.row(from);
      loss.variance[k] += residual.share * residual.share * spread[from] + alike;
    }
  }
  for (Index k = 0; k < n; ++k)
    if (rows[static_cast<std::size_t>(k)].after == 0.0) loss.variance[k] = 0.0;
  return loss;
}

double typical_spread(const std::vector<Loss>& losses) {
  std::vector<double> shares;
  for (const Loss& loss : losses) {
    const double size = loss.known() ? finite_size(loss.signal) : 0.0;
    if (size > 0.0)
      shares.push_back(std::hypot(loss.factors.bridge.norm(), loss.factors.epoch.norm()) / size);
  }
  if (shares.empty()) return 1.0;
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  return *middle;
}

}  // namespace voussoir
