#include "lookup/evidence/unknown_screen.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/threads.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr auto kAllDirections = static_cast<Index>(kDirections);
constexpr auto kEpochs = static_cast<Index>(kEpochColumns);
constexpr int kIterations = 2;  // of the leading directions, which need not be exact

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
  for (Index i = 0; i < kAllDirections; ++i)
    for (Index j = 0; j <= i; ++j)
      lower[lower_size(static_cast<std::size_t>(i)) + static_cast<std::size_t>(j)] = matrix(i, j);
}

/// log density of no difference at all.
ScatterLogs log_peak(const MatrixXd& noise, const MatrixXd& bridge) {
  const std::vector<double> none(static_cast<std::size_t>(noise.rows()), 0.0);
  return ScatterDensity()(none, lower_of(noise), lower_of(bridge));
}

/// What the density of all rows has more than that of the first few directions, which goes without its powers
/// of two pi.
ScatterLogs log_outside(const ScatterLogs& peaks, const MatrixXd& noise, const MatrixXd& bridge,
                        std::size_t directions) {
  const Index few = std::min(static_cast<Index>(directions), noise.rows());
  const ScatterLogs inside = log_peak(noise.topLeftCorner(few, few), bridge.topLeftCorner(few, few));
  const double powers = 0.5 * static_cast<double>(few) * std::log(2.0 * std::numbers::pi);
  ScatterLogs logs = peaks;
  for (std::size_t k = 0; k < logs.size(); ++k) logs[k] -= inside[k] + powers;
  return logs;
}

}  // namespace

UnknownScreen::UnknownScreen(UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                             std::span<const UnknownCase> cases, int threads)
    : bridge_(bridge), observation_(observation), table_(table) {
  const MatrixXd product = intact_product(bridge);
  const MatrixXd epoch = epoch_columns(bridge, {});
  MatrixXd always = epoch * epoch.transpose();
  std::vector<MatrixXd> others;
  for (const UnknownCase& one : cases) {
    set_case(observation, one, bridge);
    others.push_back(bridge.noise + bridge.conditions * bridge.conditions * always +
                     bridge.scale * bridge.scale * bridge.movement * bridge.movement.transpose());
    cases_.push_back({bridge.conditions * bridge.conditions, bridge.spread * bridge.spread});
  }
  choose_directions(others, product);
  choose_epoch_columns();
  epoch_after_ = directions_.transpose() * epoch.rightCols(bridge.factors->of_epoch());
  store_lower(directions_.transpose() * (product * directions_), bridge_of_intact_);
  for (std::size_t k = 0; k < cases.size(); ++k) add_intact(others[k], product, cases_[k]);
  nothing_.assign(bridge.rows.size(), 0.0);
  none_.signal_of_rows = nothing_.data();
  losses_.resize(bridge.losses.size());
  for_each_index_on_threads(losses_.size(), threads, [&](std::size_t place) {
    if (bridge_.losses[place].known()) losses_[place] = reduced(bridge_.losses[place]);
  });
}

void UnknownScreen::add_intact(const MatrixXd& others, const MatrixXd& bridge, ReducedCase& to) const {
  to.peaks = log_peak(others, bridge);
  to.peak = over_scatter(to.peaks);
  const Index used = std::min(kAllDirections, directions_.rows());
  const auto few = directions_.leftCols(used);
  const MatrixXd reduced_bridge = few.transpose() * (bridge * few),
                 reduced_others = few.transpose() * (others * few);
  to.outside_few = log_outside(to.peaks, reduced_others, reduced_bridge, kFirstDirections);
  to.outside_more = log_outside(to.peaks, reduced_others, reduced_bridge, kMoreDirections);
  to.outside_all = log_outside(to.peaks, reduced_others, reduced_bridge, kDirections);
  MatrixXd all = MatrixXd::Identity(kAllDirections, kAllDirections);  // beyond those that there are
  all.topLeftCorner(used, used) = reduced_others;
  store_lower(all, to.others);
}

/// In which the readings are farthest from the intact bridge, in each case; orthonormal in whitened readings.
MatrixXd UnknownScreen::reading_directions(std::span<const MatrixXd> others, const MatrixXd& product,
                                           const Eigen::LLT<MatrixXd>& white) const {
  const Index n = product.rows(),
              count = std::min(static_cast<Index>(others.size()), std::min(kAllDirections, n));
  MatrixXd first(n, count);
  for (Index k = 0; k < count; ++k) {
    const VectorXd direction =
        Eigen::LLT<MatrixXd>(others[static_cast<std::size_t>(k)] + product).solve(bridge_.reading);
    first.col(k) = white.matrixU() * direction;
    first.col(k) /= std::max(first.col(k).norm(), std::numeric_limits<double>::min());
  }
  return Eigen::HouseholderQR<MatrixXd>(first).householderQ() * MatrixXd::Identity(n, count);
}

void UnknownScreen::choose_directions(std::span<const MatrixXd> others, const MatrixXd& product) {
  const Eigen::LLT<MatrixXd> white(others[others.size() / 2] + product);
  const auto lower = white.matrixL();
  const Index n = product.rows(), used = std::min(kAllDirections, n);
  const MatrixXd first = reading_directions(others, product, white);
  MatrixXd losses = lower.solve(losses_product(bridge_));
  losses = lower.solve(losses.transpose().eval());
  const MatrixXd without = MatrixXd::Identity(n, n) - first * first.transpose();
  losses = without * losses * without;
  MatrixXd chosen(n, used);
  chosen.leftCols(first.cols()) = first;
  if (used > first.cols())
    chosen.rightCols(used - first.cols()) = leading_directions(losses, used - first.cols());
  chosen = Eigen::HouseholderQR<MatrixXd>(chosen).householderQ() * MatrixXd::Identity(n, used);
  directions_ = MatrixXd::Zero(n, kAllDirections);
  directions_.leftCols(used) = white.matrixU().solve(chosen);
  const auto channels = static_cast<Index>(observation_.reading.size());
  of_loss_ = of_bridge_ = MatrixXd::Zero(channels, kAllDirections);
  MatrixXd changed = directions_;
  for (std::size_t k = 0; k < bridge_.rows.size(); ++k) {
    const ReadingRow& row = bridge_.rows[k];
    const auto from = static_cast<Index>(k), to = static_cast<Index>(row.channel);
    of_loss_.row(to) += row.after * directions_.row(from);
    of_bridge_.row(to) += row.of_bridge() * directions_.row(from);
    if (row.after == 0.0) changed.row(from).setZero();
    channels_.push_back(row.channel);
    after_.push_back(row.after);
  }
  directions_by_row_ = directions_;
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
  store_lower(own * own.transpose() - first * first.transpose(), to.of_bridge.own);
  if (of_bridge_.isZero(0.0)) return;
  const MatrixXd cross = (of_bridge_.transpose() * factors.signal.intact) * own.transpose();
  store_lower(cross + cross.transpose(), to.of_bridge.crossed);
}

/// The same of E E^T, conditions being as the file states.
void UnknownScreen::reduce_epoch(const LossFactors& factors, ReducedLoss& to) const {
  const MatrixXd change = of_loss_.transpose() * factors.epoch;
  const MatrixXd first = change * epoch_columns_;
  store_rows(first, kEpochs, to.epoch.data());
  store_lower(change * change.transpose() - first * first.transpose(), to.of_epoch.own);
  const MatrixXd cross = epoch_after_ * change.transpose();
  store_lower(cross + cross.transpose(), to.of_epoch.crossed);
}

ReducedLoss UnknownScreen::reduced(const Loss& loss) const {
  ReducedLoss result;
  result.signal_of_rows = loss.signal.data();
  const VectorXd counted = loss.signal.array().isNaN().select(0.0, loss.signal);
  const VectorXd signal = directions_.transpose() * counted;
  store(signal, result.signal);
  reduce_bridge(*loss.factors, result);
  reduce_epoch(*loss.factors, result);
  store_lower(bridge_.model_error * bridge_.model_error * signal * signal.transpose(), result.model_error);
  return result;
}

ReducedQuestion UnknownScreen::question() const {
  const std::size_t rows = bridge_.rows.size();
  return {reading_.data(),
          points_.data(),
          bridge_of_intact_.data(),
          cases_,
          rows,
          channels_.data(),
          after_.data(),
          observation_.intact.data(),
          directions_by_row_.data(),
          static_cast<double>(bridge_.has_first_epoch() ? rows / 2 : rows)};
}

UnknownScreen::Lost UnknownScreen::lost(std::size_t row) const {
  const KnownLosses known = known_losses(bridge_, table_, row);
  Lost result{{&none_}};
  for (std::size_t k = 0; k < known.count; ++k) result.losses[k] = &losses_[known.place[k]];
  result.count = std::max(known.count, std::size_t{1});
  return result;
}

void UnknownScreen::estimate(std::size_t row, double least, const MatrixXd& rises,
                             std::span<double> logs) const {
  const Lost losses = lost(row);
  estimate_log_densities(question(), {table_.row(row).data(), std::span(losses.losses).first(losses.count)},
                         least, rises, logs);
}

void UnknownScreen::refine(std::size_t row, ScreenDirections directions, double least,
                           std::span<double> logs) const {
  const Lost losses = lost(row);
  refine_log_densities(question(), {table_.row(row).data(), std::span(losses.losses).first(losses.count)},
                       directions, least, logs);
}

}  // namespace voussoir
