#include "lookup/evidence/unknown_evidence.h"

#include <algorithm>
#include <limits>

#include "core/threads.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

LowerTriangle lower_of(const MatrixXd& matrix) {
  LowerTriangle lower;
  lower.reserve(lower_size(static_cast<std::size_t>(matrix.rows())));
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j <= i; ++j) lower.push_back(matrix(i, j));
  return lower;
}

/// Row by row, filled up for lanes.
void store_rows(const MatrixXd& matrix, std::vector<double>& rows) {
  const std::size_t width = padded(static_cast<std::size_t>(matrix.cols()));
  rows.assign(static_cast<std::size_t>(matrix.rows()) * width, 0.0);
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < matrix.rows(); ++i)
      rows[static_cast<std::size_t>(i) * width + static_cast<std::size_t>(j)] = matrix(i, j);
}

/// Memory of one thread.
struct Work {
  ScatterDensity density;
  std::vector<double> difference, columns, others;
  LowerTriangle noise, bridge, epoch, always;
};

/// What losses have of their own in rows of y, one beside the other.
MatrixXd beside(const UnknownBridge& bridge, const SceneLoss& loss, MatrixXd SignalFactors::*member,
                bool of_bridge) {
  Index columns = 0;
  for (const Loss* one : loss.known) columns += one->factors->signal.own.cols();
  MatrixXd result(static_cast<Index>(bridge.rows.size()), columns);
  Index first = 0;
  for (const Loss* one : loss.known) {
    const MatrixXd& from = one->factors->signal.*member;
    for (Index k = 0; k < result.rows(); ++k) {
      const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
      result.row(k).segment(first, from.cols()) =
          (of_bridge ? row.of_bridge() : row.after) * from.row(static_cast<Index>(row.channel));
    }
    first += from.cols();
  }
  return result;
}

/// A A^T of the intact bridge where it is the same in both epochs.
void store_intact(const UnknownBridge& bridge, LowerTriangle& lower) {
  double* to = lower.data();
  for (std::size_t i = 0; i < bridge.rows.size(); ++i) {
    const auto at = static_cast<Index>(bridge.rows[i].channel);
    const double c = bridge.rows[i].of_bridge();
    for (std::size_t j = 0; j <= i; ++j, ++to) {
      const double other = bridge.rows[j].of_bridge();
      *to = c == 0.0 || other == 0.0
                ? 0.0
                : c * other * bridge.factors->intact_product(static_cast<Index>(bridge.rows[j].channel), at);
    }
  }
}

/// What two losses' leading columns have in common.
void add_common(const UnknownBridge& bridge, const SceneLoss& loss, Work& work) {
  const auto lead = [&](std::size_t i, std::vector<double>& rows) {
    const MatrixXd& columns = loss.known[i]->factors->lead;
    store_rows(in_rows(bridge.rows, MatrixXd::Zero(columns.rows(), columns.cols()), columns), rows);
  };
  lead(0, work.columns);
  lead(1, work.others);
  add_symmetric_product(work.columns, work.others, bridge.rows.size(), work.bridge);
}

/// A A^T. A is c A_intact + a D in rows of y, c of what is the same in both epochs and a of what is after; so
/// a D (a D)^T + a D (c A_intact)^T + c A_intact (a D)^T = X Y^T + Y X^T with X = a B and Y = c H + a B / 2.
void store_bridge(const UnknownBridge& bridge, const SceneLoss& loss, Work& work) {
  const std::size_t n = bridge.rows.size();
  work.bridge.resize(lower_size(n));
  store_intact(bridge, work.bridge);
  if (loss.known.empty()) return;
  const MatrixXd own = beside(bridge, loss, &SignalFactors::own, false);
  const MatrixXd intact = beside(bridge, loss, &SignalFactors::intact, true);
  store_rows(own, work.columns);
  if (intact.isZero(0.0)) {
    add_outer_product(work.columns, n, work.bridge);
  } else {
    store_rows(intact + 0.5 * own, work.others);
    add_symmetric_product(work.columns, work.others, n, work.bridge);
  }
  if (loss.known.size() == 2) add_common(bridge, loss, work);
}

void store_outer_product(const MatrixXd& columns, std::vector<double>& rows, LowerTriangle& lower) {
  lower.assign(lower_size(static_cast<std::size_t>(columns.rows())), 0.0);
  store_rows(columns, rows);
  add_outer_product(rows, static_cast<std::size_t>(columns.rows()), lower);
}

/// What no case changes of the scene's Gaussian.
void store_scene(const UnknownBridge& bridge, const SceneLoss& loss, Work& work) {
  const Eigen::VectorXd difference = bridge.reading - loss.signal;
  work.difference.assign(difference.begin(), difference.end());
  store_bridge(bridge, loss, work);
  store_outer_product(epoch_columns(bridge, loss), work.columns, work.epoch);
  store_outer_product(other_columns(bridge, loss), work.columns, work.always);
}

ScatterLogs logs_of(const UnknownBridge& bridge, const SceneLoss& loss, const CaseTerms& one, Work& work) {
  const double conditions = one.conditions * one.conditions;
  work.noise.resize(one.noise.size());
  for (std::size_t i = 0; i < one.noise.size(); ++i)
    work.noise[i] = one.noise[i] + conditions * work.epoch[i] + work.always[i];
  if (loss.mean_square_beyond > 0.0) {
    const double square = one.spread * one.spread;
    for (std::size_t i = 0; i < bridge.rows.size(); ++i) {
      const double own = square * loss.beyond[static_cast<Index>(i)];
      double* const to = work.noise.data() + lower_size(i);
      for (std::size_t j = 0; j <= i; ++j) to[j] += own * loss.beyond[static_cast<Index>(j)];
      if (bridge.rows[i].after != 0.0) to[i] += square * loss.mean_square_beyond;
    }
  }
  return work.density(work.difference, work.noise, work.bridge);
}

}  // namespace

CaseTerms case_terms(const UnknownBridge& bridge) {
  return {bridge.conditions, bridge.spread, lower_of(bridge.noise)};
}

std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, std::span<const CaseTerms> cases,
                                      const Observation& observation, const SceneTable& table,
                                      std::span<const std::size_t> rows, std::span<const std::uint8_t> wanted,
                                      int threads) {
  ScatterLogs impossible;
  impossible.fill(kImpossible);
  std::vector<ScatterLogs> result(rows.size() * cases.size(), impossible);
  for_each_index_on_threads(rows.size(), threads, [&](std::size_t i) {
    thread_local Work work;
    const auto loss = scene_loss(bridge, observation, table, rows[i]);
    if (!loss) return;
    store_scene(bridge, *loss, work);
    for (std::size_t at = i * cases.size(); at < (i + 1) * cases.size(); ++at)
      if (wanted.empty() || wanted[at] != 0)
        result[at] = logs_of(bridge, *loss, cases[at % cases.size()], work);
  });
  return result;
}

std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, const Observation& observation,
                                      const SceneTable& table, std::span<const std::size_t> rows,
                                      int threads) {
  const std::array<CaseTerms, 1> cases = {case_terms(bridge)};
  return scatter_logs(bridge, cases, observation, table, rows, {}, threads);
}

}  // namespace voussoir
