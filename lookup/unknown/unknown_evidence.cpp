#include "lookup/unknown/unknown_evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "core/simd/column_products.h"
#include "core/threads.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Memory of one thread.
struct Work {
  ScatterDensity density;
  std::vector<double> difference;
  LowerTriangle noise, other, bridge, epoch, always;
};

/// Channels in rows of y, each with a weight, filled up (add_lower_product).
template <class Weight>
MatrixXd weighted_rows(const UnknownBridge& bridge, const MatrixXd& channels, Weight weight) {
  const auto n = static_cast<Index>(bridge.rows.size());
  MatrixXd result(static_cast<Index>(padded(bridge.rows.size(), kColumnUnit)), channels.cols());
  result.bottomRows(result.rows() - n).setZero();
  for (Index j = 0; j < result.cols(); ++j)
    for (Index k = 0; k < n; ++k) {
      const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
      result(k, j) = weight(row) * channels(static_cast<Index>(row.channel), j);
    }
  return result;
}

double weight_after(const ReadingRow& row) {
  return row.after;
}
double weight_of_bridge(const ReadingRow& row) {
  return row.of_bridge();
}

void add_to(LowerTriangle& sum, const LowerTriangle& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

/// What no case changes of the scene's Gaussian, but for A A^T.
void store_scene(const UnknownBridge& bridge, const SceneLoss& loss, Work& work) {
  const Eigen::VectorXd difference = bridge.reading - loss.signal;
  work.difference.assign(difference.begin(), difference.end());
  work.epoch = outer_product(epoch_columns(bridge, loss));
  work.always = outer_product(other_columns(bridge, loss));
}

/// Everything but A A^T in a case.
void store_noise(const UnknownBridge& bridge, const SceneLoss& loss, const CaseTerms& one, const Work& work,
                 LowerTriangle& noise) {
  const double conditions = one.conditions * one.conditions;
  noise.resize(one.noise.size());
  for (std::size_t i = 0; i < one.noise.size(); ++i)
    noise[i] = one.noise[i] + conditions * work.epoch[i] + work.always[i];
  if (!loss.beyond.isZero(0.0)) {
    const double square = one.spread * one.spread;
    for (std::size_t i = 0; i < bridge.rows.size(); ++i) {
      const double own = square * loss.beyond[static_cast<Index>(i)];
      double* const to = noise.data() + lower_size(i);
      for (std::size_t j = 0; j <= i; ++j) to[j] += own * loss.beyond[static_cast<Index>(j)];
      if (bridge.rows[i].after != 0.0) to[i] += square * loss.square_at_points;
    }
  }
}

/// The cases of one scene, two at a time.
struct SceneCases {
  const UnknownBridge& bridge;
  const SceneLoss& loss;
  std::span<const CaseTerms> cases;
  Work& work;
  std::span<ScatterLogs> logs;
  std::span<const std::uint8_t> wanted{};
  double least = kImpossible;
  const MatrixXd* rise = nullptr;
  std::vector<double> bounds{};

  void work_out() {
    bounds.assign(cases.size(), std::numeric_limits<double>::infinity());
    const std::size_t none = cases.size();
    std::size_t first = none;  // of two
    for (std::size_t k = 0; k < cases.size(); ++k) {
      if ((!wanted.empty() && wanted[k] == 0) || bounds[k] < least) continue;
      store_noise(bridge, loss, cases[k], work, first == none ? work.noise : work.other);
      if (first == none) {
        first = k;
        continue;
      }
      const auto both = work.density(work.difference, work.noise, work.other, work.bridge);
      store(first, both[0]);
      store(k, both[1]);
      first = none;
    }
    if (first != none) store(first, work.density(work.difference, work.noise, work.bridge));
  }
  void store(std::size_t k, const ScatterLogs& found) {
    logs[k] = found;
    if (rise == nullptr) return;
    const double log = over_scatter(found);
    for (std::size_t later = k + 1; later < cases.size(); ++later)
      bounds[later] =
          std::min(bounds[later], log + (*rise)(static_cast<Index>(k), static_cast<Index>(later)));
  }
};

}  // namespace

CaseTerms case_terms(const CaseNoise& noise) {
  return {noise.conditions, noise.spread, lower_of(noise.covariance)};
}

std::vector<CaseTerms> case_terms(const UnknownBridge& bridge, const Observation& observation,
                                  std::span<const UnknownCase> cases) {
  std::vector<CaseTerms> terms;
  for (const UnknownCase& one : cases) terms.push_back(case_terms(case_noise(bridge, observation, one)));
  return terms;
}

SceneLikelihoods::SceneLikelihoods(const UnknownBridge& bridge, const Observation& observation,
                                   const SceneTable& table)
    : bridge_(bridge),
      observation_(observation),
      table_(table),
      intact_(lower_of(intact_product(bridge))),
      losses_(bridge.losses.size()) {}

/// A is c A_intact + a D in rows of y, c of what is the same in both epochs and a of what is after; so what a
/// loss adds is a D (a D)^T + a D (c A_intact)^T + c A_intact (a D)^T = X X^T + X Y^T + Y X^T with X = a B
/// and Y = c H. What the leading columns of several losses have in common, L M^T + M L^T of any two, is (L +
/// M + ..) (L + M + ..)^T - L L^T - M M^T - ..
SceneLikelihoods::Products SceneLikelihoods::products_of(const Loss& loss) const {
  const std::size_t n = bridge_.rows.size();
  Products result;
  const MatrixXd own = weighted_rows(bridge_, loss.factors->own.all(), weight_after);
  result.alone.assign(lower_size(n), 0.0);
  add_lower_product(own, own, n, 1.0, result.alone);
  const auto counts = [](const ReadingRow& row) { return row.of_bridge() != 0.0; };
  if (std::any_of(bridge_.rows.begin(), bridge_.rows.end(), counts)) {
    const MatrixXd intact = weighted_rows(bridge_, loss.factors->intact.all(), weight_of_bridge);
    add_lower_product(own, intact, n, 1.0, result.alone);
    add_lower_product(intact, own, n, 1.0, result.alone);
  }
  result.lead = weighted_rows(bridge_, loss.factors->lead.all(), weight_after);
  result.beside = result.alone;
  add_lower_product(result.lead, result.lead, n, -1.0, result.beside);
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

/// A A^T of a scene.
void SceneLikelihoods::store_bridge(std::size_t row, LowerTriangle& sum) const {
  sum = intact_;
  const KnownLosses known = known_losses(bridge_, table_, row);
  for (const std::size_t place : std::span(known.place).first(known.count))
    add_to(sum, known.count == 1 ? losses_[place].alone : losses_[place].beside);
  if (known.count < 2) return;
  MatrixXd lead = losses_[known.place[0]].lead;
  for (std::size_t more = 1; more < known.count; ++more) lead += losses_[known.place[more]].lead;
  add_lower_product(lead, lead, bridge_.rows.size(), 1.0, sum);
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
    store_bridge(rows[i], work.bridge);
    SceneCases scene{bridge_, *loss, cases, work, std::span(result).subspan(i * cases.size(), cases.size())};
    if (!wanted.empty()) scene.wanted = wanted.subspan(i * cases.size(), cases.size());
    if (pruning != nullptr) scene.least = pruning->least[i], scene.rise = &pruning->rise;
    scene.work_out();
  });
  return result;
}

Eigen::VectorXd SceneLikelihoods::pull(const CaseTerms& one, std::size_t row) {
  prepare({&row, 1}, 1);
  Work work;
  const SceneLoss loss = scene_loss(bridge_, observation_, table_, row).value();
  store_scene(bridge_, loss, work);
  store_bridge(row, work.bridge);
  store_noise(bridge_, loss, one, work, work.noise);
  add_to(work.noise, work.bridge);
  const Eigen::LLT<MatrixXd> covariance(matrix_of(work.noise, bridge_.reading.size()));
  return covariance.solve(bridge_.reading - loss.signal);
}

}  // namespace voussoir
