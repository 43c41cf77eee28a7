#include "lookup/unknown/unknown_screen.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/fetch.h"
#include "core/simd/column_products.h"
#include "core/threads.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/unknown/leading_directions.h"
#include "lookup/unknown/peak_density.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr auto kAllDirections = static_cast<Index>(kDirections);
constexpr auto kEpochs = static_cast<Index>(kEpochColumns);
/// Columns count if without them and all that follow some reading's variance could be so much less.
constexpr double kTooSmall = 1e-3;
constexpr std::size_t kFetchedAhead = 2 * kFloatLanes;  // rows

/// What all losses change, their signals and their scatter, in rows of y.
MatrixXd losses_product(const UnknownBridge& bridge) {
  const auto n = static_cast<Index>(bridge.rows.size());
  MatrixXd signals(n, static_cast<Index>(bridge.blocks));
  for (std::size_t block = 0; block < bridge.blocks; ++block) {
    const VectorXd& signal = bridge.losses[block].signal;
    const bool counts = signal.size() > 0 && !signal.hasNaN();
    signals.col(static_cast<Index>(block)) = counts ? signal : VectorXd::Zero(n);
  }
  return signals * signals.transpose() + product_in_rows(bridge.rows, bridge.factors->signal_product,
                                                         [](const ReadingRow& row) { return row.after; });
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

/// Adds the lower triangle of factor a b^T.
void add_lower(const DirectionColumns& a, const DirectionColumns& b, double factor,
               DirectionTriangle& lower) {
  add_lower_product(a.data(), b.data(), kDirections, static_cast<std::size_t>(b.cols()), {0, kDirections},
                    factor, lower.data());
}

}  // namespace

UnknownScreen::UnknownScreen(const UnknownBridge& bridge, const Observation& observation,
                             const SceneTable& table, std::span<const UnknownCase> cases,
                             const MatrixXd& pulls, int threads)
    : bridge_(bridge), observation_(observation), table_(table) {
  const MatrixXd product = intact_product(bridge);
  const MatrixXd epoch = epoch_columns(bridge, {});
  MatrixXd always = epoch * epoch.transpose();
  std::vector<MatrixXd> others;
  for (const UnknownCase& one : cases) {
    const CaseNoise noise = case_noise(bridge, observation, one);
    const double conditions = noise.conditions * noise.conditions;
    others.push_back(noise.covariance + conditions * always +
                     bridge.scale * bridge.scale * bridge.movement * bridge.movement.transpose());
    cases_.push_back({conditions, noise.spread * noise.spread});
    least_variance_ = noise.least_variance;
  }
  choose_directions(others, product, pulls);
  epoch_after_ = directions_.transpose() * epoch.rightCols(bridge.factors->of_epoch());
  const MatrixXd reduced_product = directions_.transpose() * (product * directions_);
  store_lower(reduced_product, bridge_of_intact_);
  for (std::size_t k = 0; k < cases.size(); ++k) add_intact(others[k], product, reduced_product, cases_[k]);
  none_.signal.assign(intact_.size(), 0.0);
  none_.shown = intact_;
  reduce_losses(threads);
}

void UnknownScreen::add_intact(const MatrixXd& others, const MatrixXd& bridge, const MatrixXd& reduced_bridge,
                               ReducedCase& to) const {
  to.peaks = log_peak(others, bridge);
  to.peak = over_scatter(to.peaks);
  const Index used = std::min(kAllDirections, directions_.rows());
  const auto few = directions_.leftCols(used);
  const MatrixXd reduced_others = few.transpose() * (others * few);
  for (std::size_t k = 0; k < kScreenDirections.size(); ++k)
    to.outside[k] =
        log_outside(to.peaks, reduced_others, reduced_bridge, static_cast<std::size_t>(kScreenDirections[k]));
  MatrixXd all = MatrixXd::Identity(kAllDirections, kAllDirections);  // beyond those that there are
  all.topLeftCorner(used, used) = reduced_others;
  store_lower(all, to.others);
}

/// In which the readings are farthest from the intact bridge, in each case; orthonormal in whitened readings.
MatrixXd UnknownScreen::reading_directions(std::span<const MatrixXd> others, const MatrixXd& product,
                                           const MatrixXd& pulls, const Eigen::LLT<MatrixXd>& white) const {
  const Index n = product.rows(), cases = static_cast<Index>(others.size()),
              count = std::min(cases + pulls.cols(), std::min(kAllDirections, n));
  MatrixXd first(n, count);
  for (Index k = 0; k < count; ++k) {
    const VectorXd direction =
        k < cases ? Eigen::LLT<MatrixXd>(others[static_cast<std::size_t>(k)] + product).solve(bridge_.reading)
                  : VectorXd(pulls.col(k - cases));
    first.col(k) = white.matrixU() * direction;
    first.col(k) /= std::max(first.col(k).norm(), std::numeric_limits<double>::min());
  }
  return Eigen::HouseholderQR<MatrixXd>(first).householderQ() * MatrixXd::Identity(n, count);
}

void UnknownScreen::choose_directions(std::span<const MatrixXd> others, const MatrixXd& product,
                                      const MatrixXd& pulls) {
  const Eigen::LLT<MatrixXd> white(others[others.size() / 2] + product);
  const auto lower = white.matrixL();
  const Index n = product.rows(), used = std::min(kAllDirections, n);
  const MatrixXd first = reading_directions(others, product, pulls, white);
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
  intact_ = observation_.intact;
  intact_.resize(padded(intact_.size(), kFloatLanes));
  is_read_.assign(intact_.size(), 0.0);
  MatrixXd of_loss = MatrixXd::Zero(channels, kAllDirections), of_bridge = of_loss;
  MatrixXd changed = directions_;
  for (std::size_t k = 0; k < bridge_.rows.size(); ++k) {
    const ReadingRow& row = bridge_.rows[k];
    const auto from = static_cast<Index>(k), to = static_cast<Index>(row.channel);
    of_loss.row(to) += row.after * directions_.row(from);
    of_bridge.row(to) += row.of_bridge() * directions_.row(from);
    if (row.after == 0.0) changed.row(from).setZero();
    if (row.after != 0.0) is_read_[row.channel] = 1.0;
  }
  store_lower(changed.transpose() * changed, points_);
  store(directions_.transpose() * bridge_.reading, reading_);
  directions_by_channel_.resize(intact_.size() * kDirections);
  store_rows(of_loss, kAllDirections, directions_by_channel_.data());
  rounded_directions_.assign(directions_by_channel_.begin(), directions_by_channel_.end());
  if (of_bridge.isZero(0.0)) return;
  of_bridge_by_channel_.resize(directions_by_channel_.size());
  store_rows(of_bridge, kAllDirections, of_bridge_by_channel_.data());
}

/// The combinations of an epoch's parameters in which losses change most; how each changes the parameters.
MatrixXd UnknownScreen::epoch_columns_of(std::span<const DirectionColumns> changes) const {
  const Index parameters = bridge_.factors->of_epoch();
  MatrixXd product = MatrixXd::Zero(parameters, parameters);
  for (const DirectionColumns& change : changes)
    if (change.size() > 0) product.noalias() += change.transpose() * change;
  if (parameters == 0) return product;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(product);
  return solver.eigenvectors().rightCols(std::min(parameters, kEpochs));
}

void UnknownScreen::reduce_losses(int threads) {
  losses_.resize(bridge_.losses.size());
  std::vector<DirectionColumns> changes(losses_.size());  // of E, conditions being as the file states
  const auto for_each_known = [&](const auto& work) {
    for_each_index_on_threads(losses_.size(), threads, [&](std::size_t place) {
      if (bridge_.losses[place].known()) work(bridge_.losses[place], place);
    });
  };
  for_each_known([&](const Loss& loss, std::size_t place) {
    reduce(loss, losses_[place]);
    changes[place] = projected(loss.factors->epoch, directions_by_channel_);
  });
  const MatrixXd columns = epoch_columns_of(changes);
  for_each_known([&](const Loss&, std::size_t place) {
    ReducedLoss& loss = losses_[place];
    reduce_epoch(changes[place], changes[place] * columns, loss.exact);
    loss.rounded = rounded(loss.exact);
  });
}

DirectionColumns UnknownScreen::projected(const MatrixXd& columns,
                                          const std::vector<double>& by_channel) const {
  DirectionColumns result(kAllDirections, columns.cols());
  if (columns.cols() > 0)
    project_columns(by_channel.data(), static_cast<std::size_t>(columns.rows()), columns.data(),
                    static_cast<std::size_t>(columns.cols()), kDirections, result.data());
  return result;
}

/// What a loss adds to A A^T, of which the first columns show what it has in common with others.
void UnknownScreen::reduce_bridge(const LossFactors& factors, LossInDirections<double>& to) const {
  const DirectionColumns first = projected(factors.lead.leading(kFirstColumns), directions_by_channel_);
  store_rows(first, kFirstColumns, to.first.data());
  const Index shown = factors.own.that_show(kTooSmall * least_variance_);
  const DirectionColumns columns = projected(factors.own.leading(shown), directions_by_channel_);
  DirectionTriangle crossed{}, own{};
  add_lower(columns, columns, 1.0, own);
  add_lower(first, first, -1.0, own);
  if (!of_bridge_by_channel_.empty()) {
    const DirectionColumns intact = projected(factors.intact.leading(shown), of_bridge_by_channel_);
    add_lower(columns, intact, 1.0, crossed);
    add_lower(intact, columns, 1.0, crossed);
  }
  to.of_bridge = reduced_part(crossed, own);
}

/// The same of E E^T.
void UnknownScreen::reduce_epoch(const DirectionColumns& change, const DirectionColumns& first,
                                 LossInDirections<double>& to) const {
  store_rows(first, kEpochs, to.epoch.data());
  DirectionTriangle crossed{}, own{};
  add_lower(change, change, 1.0, own);
  add_lower(first, first, -1.0, own);
  add_lower(epoch_after_, change, 1.0, crossed);
  add_lower(change, epoch_after_, 1.0, crossed);
  to.of_epoch = reduced_part(crossed, own);
}

void UnknownScreen::reduce(const Loss& loss, ReducedLoss& to) const {
  to.signal.assign(intact_.size(), 0.0);
  MatrixXd counted = MatrixXd::Zero(static_cast<Index>(intact_.size()), 1);
  for (std::size_t k = 0; k < bridge_.rows.size(); ++k) {
    const ReadingRow& row = bridge_.rows[k];
    const double signal = loss.signal[static_cast<Index>(k)];
    if (row.after == 0.0) continue;
    to.signal[row.channel] = signal / row.after;
    if (!std::isnan(signal)) counted(static_cast<Index>(row.channel), 0) = signal / row.after;
  }
  to.shown = intact_;
  for (std::size_t i = 0; i < to.shown.size(); ++i) to.shown[i] += to.signal[i];
  const DirectionColumns signal = projected(counted, directions_by_channel_);
  store(signal, to.exact.signal);
  reduce_bridge(*loss.factors, to.exact);
  add_lower(signal, signal, bridge_.model_error * bridge_.model_error, to.exact.model_error);
}

ReducedQuestion UnknownScreen::question() const {
  double widest_point = 0.0, widest_spread = 0.0, highest_peak = kImpossible;
  for (std::size_t i = 0; i < kDirections; ++i)
    widest_point = std::max(widest_point, points_[lower_size(i) + i]);
  for (const ReducedCase& one : cases_) {
    widest_spread = std::max(widest_spread, one.spread_square);
    highest_peak = std::max(highest_peak, one.peak);
  }
  return {reading_.data(),
          points_.data(),
          bridge_of_intact_.data(),
          cases_,
          observation_.intact.size(),
          is_read_.data(),
          directions_by_channel_.data(),
          rounded_directions_.data(),
          std::accumulate(is_read_.begin(), is_read_.end(), 0.0f),
          static_cast<float>(widest_point),
          static_cast<float>(widest_spread),
          static_cast<float>(highest_peak)};
}

ScenePrediction UnknownScreen::scene(const ScreenedRow& row, const KnownLosses& known) const {
  ScenePrediction result{table_.row(row.row).data(), {&none_}, row.least, known.all ? 0.0F : 1.0F, row.logs};
  for (std::size_t k = 0; k < known.count; ++k) result.losses[k] = &losses_[known.place[k]];
  return result;
}

/// Calls work(scenes, count) for as many scenes as there are lanes, all with so many losses. Where scenes are
/// fewer the last one counts several times.
template <class Work>
void UnknownScreen::for_rows_together(std::span<const ScreenedRow> rows, Work work) const {
  struct Together {
    std::array<ScenePrediction, kFloatLanes> scenes;
    std::size_t count = 0;
  };
  std::array<Together, kMostLosses + 1> by_losses;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ScreenedRow& row = rows[i];
    if (i + kFetchedAhead < rows.size()) fetch(table_.row(rows[i + kFetchedAhead].row));
    const KnownLosses known = known_losses(bridge_, table_, row.row);
    const std::size_t losses = std::max(known.count, std::size_t{1});
    Together& together = by_losses[losses];
    together.scenes[together.count++] = scene(row, known);
    if (together.count < kFloatLanes) continue;
    work(together.scenes, losses);
    together.count = 0;
  }
  for (std::size_t losses = 1; losses < by_losses.size(); ++losses) {
    auto& [scenes, count] = by_losses[losses];
    if (count == 0) continue;
    std::fill(scenes.begin() + static_cast<std::ptrdiff_t>(count), scenes.end(), scenes[count - 1]);
    work(scenes, losses);
  }
}

void UnknownScreen::estimate(std::span<const ScreenedRow> rows, const MatrixXd& rises,
                             std::size_t before) const {
  const ReducedQuestion all = question();
  for_rows_together(rows, [&](const auto& scenes, std::size_t losses) {
    estimate_log_densities(all, scenes, losses, rises, before);
  });
}

void UnknownScreen::refine(std::span<const ScreenedRow> rows, ScreenDirections directions) const {
  const ReducedQuestion all = question();
  std::vector<ScreenedRow> likely;
  for (const ScreenedRow& row : rows)
    if (std::any_of(row.logs, row.logs + cases_.size(),
                    [&](float log) { return !(log < row.least) && log != kImpossible; }))
      likely.push_back(row);
  for_rows_together(likely, [&](const auto& scenes, std::size_t losses) {
    refine_log_densities(all, scenes, losses, directions);
  });
}

}  // namespace voussoir
