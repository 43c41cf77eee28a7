#include "lookup/evidence/unknown_evidence.h"

#include <algorithm>
#include <limits>

#include "core/threads.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr std::size_t kBlockRows = 8;  // that a thread takes at a time

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
  std::vector<double> difference, columns;
  LowerTriangle noise, bridge;
};

/// A's leading columns: c of what is the same in both epochs and a of what the loss changes.
void store_lead(const UnknownBridge& bridge, const SceneLoss& loss, Work& work) {
  const MatrixXd& intact = bridge.factors->intact.bridge;
  const Index lead = std::min(kLeadingColumns, intact.cols());
  MatrixXd columns(static_cast<Index>(bridge.rows.size()), lead);
  for (Index k = 0; k < columns.rows(); ++k) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
    const auto channel = static_cast<Index>(row.channel);
    columns.row(k) = row.of_bridge() * intact.row(channel).head(lead);
    for (const Loss* one : loss.known) columns.row(k) += row.after * one->factors->lead.row(channel);
  }
  store_rows(columns, work.columns);
}

/// A A^T of all other columns, from what losses keep of them.
void store_others(const UnknownBridge& bridge, const SceneLoss& loss, LowerTriangle& lower) {
  const std::vector<ReadingRow>& rows = bridge.rows;
  const MatrixXd& intact = bridge.factors->intact_own;
  double* to = lower.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = static_cast<Index>(rows[i].channel);
    const double c = rows[i].of_bridge(), a = rows[i].after;
    for (std::size_t j = 0; j <= i; ++j, ++to) {
      const auto other = static_cast<Index>(rows[j].channel);
      const double cj = rows[j].of_bridge(), aj = rows[j].after;
      double sum = c != 0.0 && cj != 0.0 ? c * cj * intact(other, at) : 0.0;
      for (const Loss* one : loss.known) {
        const LossFactors& of = *one->factors;
        sum += a * aj * of.own(other, at);
        if (c != 0.0) sum += c * aj * of.cross(at, other);
        if (cj != 0.0) sum += a * cj * of.cross(other, at);
      }
      *to = sum;
    }
  }
}

ScatterLogs logs_of(const UnknownBridge& bridge, const SceneLoss& loss, const LowerTriangle& common,
                    Work& work) {
  const std::size_t n = bridge.rows.size();
  const Eigen::VectorXd difference = bridge.reading - loss.signal, variance = beyond_variance(bridge, loss);
  work.difference.assign(difference.begin(), difference.end());
  work.noise = common;
  for (std::size_t i = 0; i < n; ++i) work.noise[lower_size(i) + i] += variance[static_cast<Index>(i)];
  MatrixXd columns(difference.size(), bridge.epochs * bridge.factors->of_epoch() + kOtherColumns);
  columns << epoch_columns(bridge, loss), other_columns(bridge, loss);
  store_rows(columns, work.columns);
  add_outer_product(work.columns, n, work.noise);
  work.bridge.resize(lower_size(n));
  store_others(bridge, loss, work.bridge);
  store_lead(bridge, loss, work);
  add_outer_product(work.columns, n, work.bridge);
  return work.density(work.difference, work.noise, work.bridge);
}

}  // namespace

std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, const Observation& observation,
                                      const SceneTable& table, std::span<const std::size_t> rows,
                                      int threads) {
  const LowerTriangle common = lower_of(bridge.noise);
  std::vector<ScatterLogs> result(rows.size());
  for_each_index_on_threads((rows.size() + kBlockRows - 1) / kBlockRows, threads, [&](std::size_t block) {
    thread_local Work work;
    for (std::size_t i = block * kBlockRows; i < std::min(rows.size(), (block + 1) * kBlockRows); ++i) {
      const auto loss = scene_loss(bridge, observation, table, rows[i]);
      if (loss)
        result[i] = logs_of(bridge, *loss, common, work);
      else
        result[i].fill(kImpossible);
    }
  });
  return result;
}

}  // namespace voussoir
