#include "lookup/evidence/unknown_screen.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simd/lane_math.h"
#include "core/threads.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t K = kDirections;
constexpr auto kFirst = static_cast<std::size_t>(kFirstColumns);
constexpr std::size_t kBlockRows = 256;  // that a thread takes at a time
constexpr double kRounding = 1e-10;      // share of a square
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// The covariance of the intact bridge's readings.
MatrixXd reference_covariance(const UnknownBridge& bridge, double kappa) {
  const MatrixXd& factors = bridge.factors->intact.bridge;
  const auto n = static_cast<Index>(bridge.rows.size());
  const MatrixXd lead = factors.leftCols(std::min(kLeadingColumns, factors.cols()));
  const MatrixXd columns = in_rows(bridge.rows, lead, lead);
  MatrixXd covariance = bridge.noise;
  for (Index i = 0; i < n; ++i) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(i)];
    for (Index j = 0; j < n; ++j) {
      const ReadingRow& other = bridge.rows[static_cast<std::size_t>(j)];
      covariance(i, j) +=
          kappa * row.of_bridge() * other.of_bridge() *
          bridge.factors->intact_own(static_cast<Index>(row.channel), static_cast<Index>(other.channel));
    }
  }
  const MatrixXd epoch = epoch_columns(bridge, {});
  covariance.noalias() += kappa * columns * columns.transpose();
  covariance.noalias() += epoch * epoch.transpose();
  covariance.noalias() += bridge.scale * bridge.scale * bridge.movement * bridge.movement.transpose();
  return covariance;
}

void store_lower(const MatrixXd& matrix, std::array<double, lower_size(K)>& lower) {
  for (std::size_t i = 0; i < K; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      lower[lower_size(i) + j] = matrix(static_cast<Index>(i), static_cast<Index>(j));
}

/// Four scenes side by side.
struct Group {
  DoubleLanes signal[K];
  DoubleLanes first[K * kFirst];
  DoubleLanes covariance[lower_size(K)];
  DoubleLanes beyond;  // variance at each changed point
};

struct Kernel {
  const double *reading, *points, *intact_first;
  double kappa, spread;
  // What rows of y are made of: channel, weight and, for each, its numbers in all directions.
  std::size_t rows;
  const std::size_t* channel;
  const double *after, *intact, *directions;
  double changed;  ///< rows of the second epoch
};

/// A scene's signal in the directions, and the variance of what is beyond its losses'. NaN: impossible.
VOUSSOIR_INLINE void project(const Kernel& kernel, const double* prediction,
                             const UnknownScreen::ReducedLoss* const* losses, std::size_t lane,
                             Group& group) {
  constexpr std::size_t kParts = K / kLanes;
  DoubleLanes sums[kParts] = {};
  double beyond = 0.0;
  const double *const first = losses[0]->signal_of_rows, *const second = losses[1]->signal_of_rows;
  for (std::size_t k = 0; k < kernel.rows; ++k) {
    const std::size_t channel = kernel.channel[k];
    const double signal =
        kernel.after[k] == 0.0 ? 0.0 : kernel.after[k] * (prediction[channel] - kernel.intact[channel]);
    const double rest = signal - first[k] - second[k];
    beyond += rest * rest;
    for (std::size_t i = 0; i < kParts; ++i)
      sums[i] += signal * load<DoubleLanes>(kernel.directions + k * K + i * kLanes);
  }
  for (std::size_t i = 0; i < K; ++i) group.signal[i][lane] = sums[i / kLanes][i % kLanes];
  group.beyond[lane] = kernel.spread * kernel.spread * beyond / kernel.changed;
}

VOUSSOIR_INLINE void add_outer(const DoubleLanes* columns, std::size_t width, double factor,
                               DoubleLanes* covariance) {
  for (std::size_t i = 0; i < K; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      DoubleLanes sum{};
      for (std::size_t p = 0; p < width; ++p) sum += columns[i * width + p] * columns[j * width + p];
      covariance[lower_size(i) + j] += factor * sum;
    }
}

/// -(log det + quadratic form) / 2 of the readings less the signals.
VOUSSOIR_INLINE DoubleLanes log_density(const Kernel& kernel, Group& group) {
  DoubleLanes squares{}, determinant = DoubleLanes{} + 1.0, logs{};
  DoubleLanes inverse[K], difference[K];
  for (std::size_t i = 0; i < K; ++i) {
    DoubleLanes* const row = group.covariance + lower_size(i);
    DoubleLanes left = kernel.reading[i] - group.signal[i];
    for (std::size_t j = 0; j < i; ++j) {
      DoubleLanes sum = row[j];
      const DoubleLanes* const other = group.covariance + lower_size(j);
      for (std::size_t p = 0; p < j; ++p) sum -= row[p] * other[p];
      row[j] = sum * inverse[j];
    }
    DoubleLanes pivot = row[i];
    for (std::size_t p = 0; p < i; ++p) {
      pivot -= row[p] * row[p];
      left -= row[p] * difference[p];
    }
    inverse[i] = 1.0 / square_root(pivot);
    difference[i] = left * inverse[i];
    squares += difference[i] * difference[i];
    determinant *= pivot;
    if (i % 4 == 3) {
      make_logarithm(determinant);
      logs += determinant;
      determinant = DoubleLanes{} + 1.0;
    }
  }
  return -0.5 * (logs + squares);
}
static_assert(K % 4 == 0, "logarithms of products of four pivots");

VOUSSOIR_INLINE void gather(const UnknownScreen::ReducedLoss* const* losses, Group& group) {
  // Of each lane two losses; their numbers add up.
  const auto add = [&](auto member, DoubleLanes* to, std::size_t count) __attribute__((always_inline)) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t l = 0; l < kLanes; ++l)
        to[i][l] += (losses[2 * l]->*member)[i] + (losses[2 * l + 1]->*member)[i];
  };
  add(&UnknownScreen::ReducedLoss::first, group.first, K * kFirst);
  add(&UnknownScreen::ReducedLoss::rest, group.covariance, lower_size(K));
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void estimate(const Kernel& kernel, const double* const* predictions,
              const UnknownScreen::ReducedLoss* const* losses, Group& group, double* results) {
  for (std::size_t l = 0; l < kLanes; ++l) project(kernel, predictions[l], losses + 2 * l, l, group);
  for (std::size_t i = 0; i < K; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      group.covariance[lower_size(i) + j] =
          (i == j ? 1.0 : 0.0) + group.beyond * kernel.points[lower_size(i) + j];
  DoubleLanes intact[K * kFirst];
  for (std::size_t i = 0; i < K * kFirst; ++i)
    intact[i] = group.first[i] = DoubleLanes{} + kernel.intact_first[i];
  gather(losses, group);
  add_outer(group.first, kFirst, kernel.kappa, group.covariance);
  add_outer(intact, kFirst, -kernel.kappa, group.covariance);
  DoubleLanes own[K];
  for (std::size_t i = 0; i < K; ++i) {
    own[i] = group.signal[i];
    for (std::size_t l = 0; l < kLanes; ++l)
      own[i][l] -= losses[2 * l]->signal[i] + losses[2 * l + 1]->signal[i];
  }
  add_outer(own, 1, kernel.spread * kernel.spread, group.covariance);
  store_some(log_density(kernel, group), kLanes, results);
}

}  // namespace

UnknownScreen::UnknownScreen(const UnknownBridge& bridge, const Observation& observation,
                             const SceneTable& table, double kappa, int threads)
    : bridge_(bridge), observation_(observation), table_(table), kappa_(kappa), threads_(threads) {
  const Eigen::LLT<MatrixXd> reference(reference_covariance(bridge, kappa));
  choose_directions(reference);
  offset_ = -reference.matrixLLT().diagonal().array().log().sum();
  const auto channels = static_cast<Index>(observation.reading.size());
  of_loss_ = of_bridge_ = MatrixXd::Zero(channels, K);
  MatrixXd changed = directions_;
  for (std::size_t k = 0; k < bridge.rows.size(); ++k) {
    const ReadingRow& row = bridge.rows[k];
    const auto from = static_cast<Index>(k), to = static_cast<Index>(row.channel);
    of_loss_.row(to) += row.after * directions_.row(from);
    of_bridge_.row(to) += row.of_bridge() * directions_.row(from);
    if (row.after == 0.0) changed.row(from).setZero();
  }
  store_lower(changed.transpose() * changed, points_);
  const VectorXd reading = directions_.transpose() * bridge.reading;
  std::copy(reading.begin(), reading.end(), reading_.begin());
  const Index first = std::min(kFirstColumns, bridge.factors->of_bridge());
  const MatrixXd intact = of_bridge_.transpose() * bridge.factors->intact.bridge.leftCols(first);
  for (std::size_t i = 0; i < K; ++i)
    for (Index j = 0; j < first; ++j)
      intact_first_[i * kFirst + static_cast<std::size_t>(j)] = intact(static_cast<Index>(i), j);
  intact_epochs_ = directions_.transpose() * epoch_columns(bridge, {});
  nothing_.assign(bridge.rows.size(), 0.0);
  none_.signal_of_rows = nothing_.data();
  losses_.resize(bridge.losses.size());
  for_each_index_on_threads(losses_.size(), threads, [&](std::size_t place) {
    if (bridge_.losses[place].known()) losses_[place] = reduced(bridge_.losses[place]);
  });
}

void UnknownScreen::choose_directions(const Eigen::LLT<MatrixXd>& reference) {
  MatrixXd left(bridge_.reading.size(), 1 + static_cast<Index>(bridge_.blocks));
  left.col(0) = bridge_.reading;
  for (std::size_t block = 0; block < bridge_.blocks; ++block) {
    const VectorXd& signal = bridge_.losses[block].signal;
    const bool counts = signal.size() > 0 && !signal.hasNaN();
    left.col(static_cast<Index>(block) + 1) = counts ? signal : VectorXd::Zero(left.rows());
  }
  reference.matrixL().solveInPlace(left);
  const VectorXd whole = left.colwise().squaredNorm();
  const VectorXd weight = (1.0 + whole.array()).inverse();
  MatrixXd chosen = MatrixXd::Zero(left.rows(), K);
  for (Index k = 0; k < std::min<Index>(K, left.rows()); ++k) {
    Index farthest = 0;
    const VectorXd sizes = left.colwise().squaredNorm();
    if (k > 0) sizes.cwiseProduct(weight).maxCoeff(&farthest);
    if (sizes[farthest] <= kRounding * whole[farthest]) continue;  // nothing but rounding is left
    chosen.col(k) = left.col(farthest) / std::sqrt(sizes[farthest]);
    left.noalias() -= chosen.col(k) * (chosen.col(k).transpose() * left).eval();
  }
  directions_ = reference.matrixL().transpose().solve(chosen);
}

UnknownScreen::ReducedLoss UnknownScreen::reduced(const Loss& loss) const {
  const LossFactors& factors = *loss.factors;
  ReducedLoss result;
  result.signal_of_rows = loss.signal.data();
  const VectorXd counted = loss.signal.array().isNaN().select(0.0, loss.signal);
  const VectorXd signal = directions_.transpose() * counted;
  std::copy(signal.begin(), signal.end(), result.signal.begin());
  const Index width = std::min(kFirstColumns, factors.lead.cols());
  const MatrixXd first = of_loss_.transpose() * factors.lead.leftCols(width);
  for (std::size_t i = 0; i < K; ++i)
    for (Index j = 0; j < width; ++j)
      result.first[i * kFirst + static_cast<std::size_t>(j)] = first(static_cast<Index>(i), j);
  MatrixXd rest = kappa_ * (of_loss_.transpose() * (factors.own_beyond_first * of_loss_));
  if (!of_bridge_.isZero(0.0)) {
    const MatrixXd cross = kappa_ * (of_bridge_.transpose() * (factors.cross_beyond_first * of_loss_));
    rest += cross + cross.transpose();
  }
  MatrixXd epochs = intact_epochs_;
  epochs.rightCols(factors.epoch.cols()) += bridge_.conditions * (of_loss_.transpose() * factors.epoch);
  rest += epochs * epochs.transpose() - intact_epochs_ * intact_epochs_.transpose();
  rest += bridge_.model_error * bridge_.model_error * signal * signal.transpose();
  store_lower(rest, result.rest);
  return result;
}

std::vector<double> UnknownScreen::estimates(std::span<const std::size_t> rows) const {
  std::vector<double> result(rows.size());
  const std::size_t n = bridge_.rows.size();
  std::vector<std::size_t> channel;
  std::vector<double> after;
  for (const ReadingRow& row : bridge_.rows) channel.push_back(row.channel), after.push_back(row.after);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> directions = directions_;
  const Kernel kernel{reading_.data(),
                      points_.data(),
                      intact_first_.data(),
                      kappa_,
                      bridge_.spread,
                      n,
                      channel.data(),
                      after.data(),
                      observation_.intact.data(),
                      directions.data(),
                      static_cast<double>(bridge_.has_first_epoch() ? n / 2 : n)};
  const std::size_t blocks = (rows.size() + kBlockRows - 1) / kBlockRows;
  for_each_index_on_threads(blocks, threads_, [&](std::size_t block) {
    const std::size_t end = std::min(rows.size(), (block + 1) * kBlockRows);
    for (std::size_t first = block * kBlockRows; first < end; first += kLanes) {
      alignas(sizeof(DoubleLanes)) Group group{};
      std::array<const ReducedLoss*, kMostLosses * kLanes> losses{};
      std::array<const double*, kLanes> predictions{};
      for (std::size_t l = 0; l < kLanes; ++l) {
        const std::size_t row = rows[std::min(first + l, end - 1)];
        const KnownLosses known = known_losses(bridge_, table_, row);
        for (std::size_t k = 0; k < kMostLosses; ++k)
          losses[kMostLosses * l + k] = k < known.count ? &losses_[known.place[k]] : &none_;
        predictions[l] = table_.row(row).data();
      }
      std::array<double, kLanes> logs{};
      estimate(kernel, predictions.data(), losses.data(), group, logs.data());
      for (std::size_t l = 0; l < kLanes && first + l < end; ++l)
        result[first + l] = std::isnan(group.beyond[l]) ? kImpossible : logs[l] + offset_;
    }
  });
  return result;
}

}  // namespace voussoir
