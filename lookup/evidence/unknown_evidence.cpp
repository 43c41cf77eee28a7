#include "lookup/evidence/unknown_evidence.h"

#include <algorithm>
#include <limits>

#include "core/threads.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

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
  LowerTriangle noise, bridge, epoch, always;
};

/// Channels in rows of y, as they count after the loss or as what is the same in both epochs does.
MatrixXd rows_after(const UnknownBridge& bridge, const MatrixXd& channels) {
  return in_rows(bridge.rows, MatrixXd::Zero(channels.rows(), channels.cols()), channels);
}
MatrixXd rows_of_bridge(const UnknownBridge& bridge, const MatrixXd& channels) {
  return in_rows(bridge.rows, channels, channels);
}

LowerTriangle intact_triangle(const UnknownBridge& bridge) {
  LowerTriangle lower(lower_size(bridge.rows.size()));
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
  return lower;
}

void add_to(LowerTriangle& sum, const LowerTriangle& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

void store_outer_product(const MatrixXd& columns, std::vector<double>& rows, LowerTriangle& lower) {
  lower.assign(lower_size(static_cast<std::size_t>(columns.rows())), 0.0);
  store_rows(columns, rows);
  add_outer_product(rows, static_cast<std::size_t>(columns.rows()), lower);
}

/// What no case changes of the scene's Gaussian, but for A A^T.
void store_scene(const UnknownBridge& bridge, const SceneLoss& loss, Work& work) {
  const Eigen::VectorXd difference = bridge.reading - loss.signal;
  work.difference.assign(difference.begin(), difference.end());
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

SceneLikelihoods::SceneLikelihoods(const UnknownBridge& bridge, const Observation& observation,
                                   const SceneTable& table)
    : bridge_(bridge),
      observation_(observation),
      table_(table),
      intact_(intact_triangle(bridge)),
      losses_(bridge.losses.size()) {}

/// A is c A_intact + a D in rows of y, c of what is the same in both epochs and a of what is after; so
/// a D (a D)^T + a D (c A_intact)^T + c A_intact (a D)^T = X Y^T + Y X^T with X = a B and Y = c H + a B / 2.
/// What the leading columns of several losses have in common, L M^T + M L^T of any two, is
/// (L + M + ..) (L + M + ..)^T - L L^T - M M^T - ..
SceneLikelihoods::Products SceneLikelihoods::products_of(const Loss& loss) const {
  const std::size_t n = bridge_.rows.size();
  Products result;
  std::vector<double> columns, others;
  const MatrixXd own = rows_after(bridge_, loss.factors->signal.own),
                 intact = rows_of_bridge(bridge_, loss.factors->signal.intact);
  result.alone.assign(lower_size(n), 0.0);
  store_rows(own, columns);
  if (intact.isZero(0.0)) {
    add_outer_product(columns, n, result.alone);
  } else {
    store_rows(intact + 0.5 * own, others);
    add_symmetric_product(columns, others, n, result.alone);
  }
  store_rows(rows_after(bridge_, loss.factors->lead), result.lead);
  LowerTriangle leading(lower_size(n), 0.0);
  add_outer_product(result.lead, n, leading);
  result.beside = result.alone;
  for (std::size_t i = 0; i < leading.size(); ++i) result.beside[i] -= leading[i];
  return result;
}

/// Of all losses that the scenes have.
void SceneLikelihoods::prepare(std::span<const std::size_t> rows, int threads) {
  std::vector<std::size_t> missing;
  for (const std::size_t row : rows) {
    const KnownLosses known = known_losses(bridge_, table_, row);
    for (const std::size_t place : std::span(known.place).first(known.count))
      if (losses_[place].alone.empty()) missing.push_back(place);
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  for_each_index_on_threads(missing.size(), threads, [&](std::size_t i) {
    losses_[missing[i]] = products_of(bridge_.losses[missing[i]]);
  });
}

std::vector<ScatterLogs> SceneLikelihoods::operator()(std::span<const CaseTerms> cases,
                                                      std::span<const std::size_t> rows,
                                                      std::span<const std::uint8_t> wanted, int threads,
                                                      const CasePruning* pruning) {
  prepare(rows, threads);
  ScatterLogs impossible;
  impossible.fill(kImpossible);
  std::vector<ScatterLogs> result(rows.size() * cases.size(), impossible);
  for_each_index_on_threads(rows.size(), threads, [&](std::size_t i) {
    thread_local Work work;
    const auto loss = scene_loss(bridge_, observation_, table_, rows[i]);
    if (!loss) return;
    store_scene(bridge_, *loss, work);
    work.bridge = intact_;
    const KnownLosses known = known_losses(bridge_, table_, rows[i]);
    for (const std::size_t place : std::span(known.place).first(known.count))
      add_to(work.bridge, known.count == 1 ? losses_[place].alone : losses_[place].beside);
    if (known.count > 1) {
      work.columns = losses_[known.place[0]].lead;
      for (std::size_t more = 1; more < known.count; ++more)
        for (std::size_t k = 0; k < work.columns.size(); ++k)
          work.columns[k] += losses_[known.place[more]].lead[k];
      add_outer_product(work.columns, bridge_.rows.size(), work.bridge);
    }
    std::vector<double> bounds(cases.size(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < cases.size(); ++k) {
      const std::size_t at = i * cases.size() + k;
      if (!wanted.empty() && wanted[at] == 0) continue;
      if (pruning != nullptr && bounds[k] < pruning->least[i]) continue;
      result[at] = logs_of(bridge_, *loss, cases[k], work);
      if (pruning == nullptr) continue;
      const double log = over_scatter(result[at]);
      for (std::size_t later = k + 1; later < cases.size(); ++later)
        bounds[later] =
            std::min(bounds[later], log + pruning->rise(static_cast<Index>(k), static_cast<Index>(later)));
    }
  });
  return result;
}

std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, const Observation& observation,
                                      const SceneTable& table, std::span<const std::size_t> rows,
                                      int threads) {
  const std::array<CaseTerms, 1> cases = {case_terms(bridge)};
  return SceneLikelihoods(bridge, observation, table)(cases, rows, {}, threads);
}

}  // namespace voussoir
