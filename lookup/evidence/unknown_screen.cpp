#include "lookup/evidence/unknown_screen.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/threads.h"
#include "lookup/evidence/reduced_density.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr auto K = static_cast<Index>(kDirections);
constexpr auto kEpochs = static_cast<Index>(kEpochColumns);
constexpr auto kFew = static_cast<Index>(kFirstDirections);
constexpr std::size_t kBlockRows = 256;  // that a thread takes at a time
constexpr int kIterations = 2;           // of the leading directions, which need not be exact

/// A A^T of the intact bridge in rows of y.
MatrixXd intact_product(const UnknownBridge& bridge) {
  const auto n = static_cast<Index>(bridge.rows.size());
  MatrixXd product(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const ReadingRow &row = bridge.rows[static_cast<std::size_t>(i)],
                       &other = bridge.rows[static_cast<std::size_t>(j)];
      product(i, j) =
          row.of_bridge() * other.of_bridge() *
          bridge.factors->intact_product(static_cast<Index>(row.channel), static_cast<Index>(other.channel));
    }
  return product;
}

/// What all losses change, their signals and their scatter, in rows of y.
MatrixXd losses_product(const UnknownBridge& bridge) {
  const auto n = static_cast<Index>(bridge.rows.size());
  MatrixXd signals(n, static_cast<Index>(bridge.blocks));
  for (std::size_t block = 0; block < bridge.blocks; ++block) {
    const VectorXd& signal = bridge.losses[block].signal;
    const bool counts = signal.size() > 0 && !signal.hasNaN();
    signals.col(static_cast<Index>(block)) = counts ? signal : VectorXd::Zero(n);
  }
  MatrixXd product = signals * signals.transpose();
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const ReadingRow &row = bridge.rows[static_cast<std::size_t>(i)],
                       &other = bridge.rows[static_cast<std::size_t>(j)];
      product(i, j) +=
          row.after * other.after *
          bridge.factors->signal_product(static_cast<Index>(row.channel), static_cast<Index>(other.channel));
    }
  return product;
}

/// The leading eigenvectors of a covariance, nearly: orthonormal columns, the largest first.
MatrixXd leading_directions(const MatrixXd& covariance, Index count) {
  const VectorXd sizes = covariance.diagonal();
  std::vector<Index> order(static_cast<std::size_t>(sizes.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return sizes[a] > sizes[b]; });
  MatrixXd basis(covariance.rows(), count);
  for (Index k = 0; k < count; ++k) basis.col(k) = covariance.col(order[static_cast<std::size_t>(k)]);
  const MatrixXd identity = MatrixXd::Identity(covariance.rows(), count);
  for (int i = 0; i < kIterations; ++i)
    basis = covariance * (Eigen::HouseholderQR<MatrixXd>(basis).householderQ() * identity);
  const MatrixXd orthonormal = Eigen::HouseholderQR<MatrixXd>(basis).householderQ() * identity;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> within(orthonormal.transpose() * covariance * orthonormal);
  return orthonormal * within.eigenvectors().rowwise().reverse();
}

void store(const VectorXd& vector, DirectionVector& to) {
  std::copy(vector.begin(), vector.end(), to.begin());
}

/// Row by row, each filled up to `width`.
void store_rows(const MatrixXd& matrix, Index width, double* rows) {
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) rows[i * width + j] = matrix(i, j);
}

void store_lower(const MatrixXd& matrix, DirectionTriangle& lower) {
  for (Index i = 0; i < K; ++i)
    for (Index j = 0; j <= i; ++j)
      lower[lower_size(static_cast<std::size_t>(i)) + static_cast<std::size_t>(j)] = matrix(i, j);
}

/// What a loss adds alone; and beside one or two others, with whose columns in common its own are summed up.
std::array<DirectionTriangle, kMostLosses> by_count(const MatrixXd& alone, const MatrixXd& own,
                                                    const MatrixXd& common) {
  std::array<DirectionTriangle, kMostLosses> result;
  store_lower(alone, result[0]);
  for (std::size_t others = 1; others < kMostLosses; ++others)
    store_lower(alone - common + static_cast<double>(others) * (own - common), result[others]);
  return result;
}

LowerTriangle lower_of(const MatrixXd& matrix) {
  LowerTriangle lower;
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j <= i; ++j) lower.push_back(matrix(i, j));
  return lower;
}

/// log density of no difference at all, but for the powers of two pi of so many rows.
ScatterLogs log_peak(const MatrixXd& noise, const MatrixXd& bridge) {
  const auto rows = static_cast<std::size_t>(noise.rows());
  ScatterLogs logs = ScatterDensity()(std::vector<double>(rows, 0.0), lower_of(noise), lower_of(bridge));
  for (double& one : logs) one += 0.5 * static_cast<double>(rows) * std::log(2.0 * std::numbers::pi);
  return logs;
}

/// What the density of all rows has more than that of the first few directions.
ScatterLogs log_outside(const ScatterLogs& whole, const MatrixXd& noise, const MatrixXd& bridge, Index rows,
                        Index few) {
  const ScatterLogs inside = log_peak(noise.topLeftCorner(few, few), bridge.topLeftCorner(few, few));
  ScatterLogs logs = whole;
  for (std::size_t k = 0; k < logs.size(); ++k)
    logs[k] -= inside[k] + 0.5 * static_cast<double>(rows) * std::log(2.0 * std::numbers::pi);
  return logs;
}

}  // namespace

UnknownScreen::UnknownScreen(const UnknownBridge& bridge, const Observation& observation,
                             const SceneTable& table, int threads)
    : bridge_(bridge), observation_(observation), table_(table), spread_(bridge.spread), threads_(threads) {
  const MatrixXd product = intact_product(bridge);
  MatrixXd others = bridge.noise;
  const MatrixXd epoch = bridge.conditions * epoch_columns(bridge, {});
  others.noalias() += epoch * epoch.transpose();
  others.noalias() += bridge.scale * bridge.scale * bridge.movement * bridge.movement.transpose();
  choose_directions(others + product);
  choose_epoch_columns();
  intact_epochs_ = directions_.transpose() * epoch;
  const MatrixXd reduced_product = directions_.transpose() * (product * directions_);
  MatrixXd reduced_others = directions_.transpose() * (others * directions_);
  const ScatterLogs whole = log_peak(others, product);
  const Index rows = directions_.rows(), used = std::min(K, rows);
  for (std::size_t k = 0; k < whole.size(); ++k)
    peaks_[k] = whole[k] - 0.5 * static_cast<double>(rows) * std::log(2.0 * std::numbers::pi);
  offset_ = log_outside(whole, reduced_others, reduced_product, rows, used);
  offset_of_few_ = log_outside(whole, reduced_others, reduced_product, rows, std::min(used, kFew));
  for (Index i = used; i < K; ++i) reduced_others(i, i) = 1.0;  // no direction is left
  store_lower(reduced_product, bridge_of_intact_);
  store_lower(reduced_others, others_of_intact_);
  nothing_.assign(bridge.rows.size(), 0.0);
  none_.signal_of_rows = nothing_.data();
  losses_.resize(bridge.losses.size());
  for_each_index_on_threads(losses_.size(), threads, [&](std::size_t place) {
    if (bridge_.losses[place].known()) losses_[place] = reduced(bridge_.losses[place]);
  });
}

void UnknownScreen::choose_directions(const MatrixXd& reference) {
  const Eigen::LLT<MatrixXd> factor(reference);
  const auto lower = factor.matrixL();
  const Index n = reference.rows(), used = std::min(K, n);
  VectorXd first = lower.solve(bridge_.reading);
  first /= std::max(first.norm(), std::numeric_limits<double>::min());
  MatrixXd losses = lower.solve(losses_product(bridge_));
  losses = lower.solve(losses.transpose().eval());
  const MatrixXd without = MatrixXd::Identity(n, n) - first * first.transpose();
  losses = without * losses * without;
  MatrixXd chosen(n, used);
  chosen.col(0) = first;
  if (used > 1) chosen.rightCols(used - 1) = leading_directions(losses, used - 1);
  chosen = Eigen::HouseholderQR<MatrixXd>(chosen).householderQ() * MatrixXd::Identity(n, used);
  directions_ = MatrixXd::Zero(n, K);
  directions_.leftCols(used) = lower.transpose().solve(chosen);
  const auto channels = static_cast<Index>(observation_.reading.size());
  of_loss_ = of_bridge_ = MatrixXd::Zero(channels, K);
  MatrixXd changed = directions_;
  for (std::size_t k = 0; k < bridge_.rows.size(); ++k) {
    const ReadingRow& row = bridge_.rows[k];
    const auto from = static_cast<Index>(k), to = static_cast<Index>(row.channel);
    of_loss_.row(to) += row.after * directions_.row(from);
    of_bridge_.row(to) += row.of_bridge() * directions_.row(from);
    if (row.after == 0.0) changed.row(from).setZero();
  }
  store_lower(changed.transpose() * changed, points_);
  store(directions_.transpose() * bridge_.reading, reading_);
}

/// The combinations of an epoch's parameters in which losses change most.
void UnknownScreen::choose_epoch_columns() {
  const Index parameters = bridge_.factors->of_epoch();
  epoch_columns_ = MatrixXd(parameters, 0);
  if (parameters == 0) return;
  MatrixXd product = MatrixXd::Zero(parameters, parameters);
  for (const Loss& loss : bridge_.losses) {
    if (!loss.known()) continue;
    const MatrixXd reduced = of_loss_.transpose() * loss.factors->epoch;
    product.noalias() += reduced.transpose() * reduced;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(product);
  epoch_columns_ = solver.eigenvectors().rightCols(std::min(parameters, kEpochs));
}

/// What a loss adds to A A^T, of which the first columns show what it has in common with others.
void UnknownScreen::reduce_bridge(const LossFactors& factors, ReducedLoss& to) const {
  const Index width = std::min(kFirstColumns, factors.lead.cols());
  const MatrixXd first = of_loss_.transpose() * factors.lead.leftCols(width);
  store_rows(first, kFirstColumns, to.first.data());
  const MatrixXd own = of_loss_.transpose() * factors.signal.own;
  const MatrixXd product = own * own.transpose();
  MatrixXd bridge = product;
  if (!of_bridge_.isZero(0.0)) {
    const MatrixXd cross = (of_bridge_.transpose() * factors.signal.intact) * own.transpose();
    bridge += cross + cross.transpose();
  }
  to.bridge = by_count(bridge, product, first * first.transpose());
}

/// The same of all else.
void UnknownScreen::reduce_others(const LossFactors& factors, const VectorXd& signal, ReducedLoss& to) const {
  const MatrixXd change = bridge_.conditions * (of_loss_.transpose() * factors.epoch);
  const MatrixXd first = change * epoch_columns_;
  store_rows(first, kEpochs, to.epoch.data());
  MatrixXd epochs = intact_epochs_;
  epochs.rightCols(change.cols()) += change;
  MatrixXd others = epochs * epochs.transpose() - intact_epochs_ * intact_epochs_.transpose();
  others += bridge_.model_error * bridge_.model_error * signal * signal.transpose();
  to.others = by_count(others, change * change.transpose(), first * first.transpose());
}

ReducedLoss UnknownScreen::reduced(const Loss& loss) const {
  ReducedLoss result;
  result.signal_of_rows = loss.signal.data();
  const VectorXd counted = loss.signal.array().isNaN().select(0.0, loss.signal);
  const VectorXd signal = directions_.transpose() * counted;
  store(signal, result.signal);
  reduce_bridge(*loss.factors, result);
  reduce_others(*loss.factors, signal, result);
  return result;
}

std::vector<double> UnknownScreen::estimates(std::span<const std::size_t> rows,
                                             std::span<const double> least) const {
  std::vector<double> result(rows.size());
  const std::size_t n = bridge_.rows.size();
  std::vector<std::size_t> channel;
  std::vector<double> after;
  for (const ReadingRow& row : bridge_.rows) channel.push_back(row.channel), after.push_back(row.after);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> directions = directions_;
  const ReducedQuestion question{reading_.data(),
                                 points_.data(),
                                 bridge_of_intact_.data(),
                                 others_of_intact_.data(),
                                 offset_,
                                 offset_of_few_,
                                 spread_,
                                 n,
                                 channel.data(),
                                 after.data(),
                                 observation_.intact.data(),
                                 directions.data(),
                                 static_cast<double>(bridge_.has_first_epoch() ? n / 2 : n)};
  const std::size_t blocks = (rows.size() + kBlockRows - 1) / kBlockRows;
  for_each_index_on_threads(blocks, threads_, [&](std::size_t block) {
    for (std::size_t i = block * kBlockRows; i < std::min(rows.size(), (block + 1) * kBlockRows); ++i) {
      const KnownLosses known = known_losses(bridge_, table_, rows[i]);
      std::array<const ReducedLoss*, kMostLosses> losses = {&none_};
      for (std::size_t k = 0; k < known.count; ++k) losses[k] = &losses_[known.place[k]];
      const auto lost = std::span(losses).first(std::max(known.count, std::size_t{1}));
      result[i] = reduced_log_density(question, table_.row(rows[i]).data(), lost, least[i]);
    }
  });
  return result;
}

}  // namespace voussoir
