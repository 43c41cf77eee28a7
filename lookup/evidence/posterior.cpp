#include "lookup/evidence/posterior.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/simd/lane_math.h"
#include "lookup/evidence/descending_places.h"

namespace voussoir {
namespace {

/// Returns what the sum was.
double normalise(std::vector<double>& probability) {
  const double total = std::accumulate(probability.begin(), probability.end(), 0.0);
  if (total > 0.0)
    for (double& value : probability) value /= total;
  return total;
}

/// The likeliest rows that hold enough together. Rows below an even distribution of what may be left out
/// cannot be needed.
std::vector<std::size_t> credible_set(const RowValues& probability) {
  const std::vector<double>& values = probability.values;
  const double negligible = (1.0 - kCredibleShare) / static_cast<double>(values.size());
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] >= negligible) places.push_back(i);
  DescendingPlaces likely(std::move(places), values);
  std::vector<std::size_t> rows;
  for (double share = 0.0; share < kCredibleShare && !likely.empty();) {
    const std::size_t place = likely.next();
    rows.push_back(probability.rows[place]);
    share += values[place];
  }
  return rows;
}

/// A bridge that is read stands: losses that would let it fall, which any readings rule out, are not what
/// damage is as likely as.
double intact_if_even(const Posterior& posterior, const SceneTable& table, const Eligible& eligible,
                      const std::vector<double>& log_prior) {
  double before = 0.0, after = 0.0;
  for (std::size_t missing = 1; missing < eligible.standing.size(); ++missing)
    before += eligible.standing[missing] * std::exp(log_prior[missing]);
  const RowValues& probability = posterior.probability;
  for (std::size_t i = 0; i < probability.rows.size(); ++i)
    if (missing_blocks(table, probability.rows[i]) > 0 && table.may_stand(probability.rows[i]))
      after += probability.values[i];
  const double intact = intact_probability(posterior);
  const double intact_before = eligible.scenes[0] * std::exp(log_prior[0]);
  if (before == 0.0 || intact_before == 0.0) return intact;
  return intact / intact_before / (intact / intact_before + after / before);
}

std::vector<OpenLoss> open_losses(const SceneTable& table, const RowValues& probability,
                                  const std::vector<double>& log_prior) {
  std::vector<OpenLoss> open;
  const double intact = probability.rows.empty() || missing_blocks(table, probability.rows.front()) != 0
                            ? 0.0
                            : probability.values.front();
  if (intact == 0.0) return open;
  for (std::size_t i = 1; i < probability.rows.size(); ++i) {
    const std::size_t row = probability.rows[i];
    if (missing_blocks(table, row) > 1) break;
    const double ratio =
        probability.values[i] / intact * std::exp(log_prior[0] - log_prior[1]) / table.weight(row);
    if (ratio > 1.0 / kSpokenAgainst && table.may_stand(row)) open.push_back({row, ratio});
  }
  return open;
}

}  // namespace

Prior stated_prior(Prior prior, const SceneTable& table, bool known_bridge) {
  if (prior.missing.empty()) prior.missing = numbers_of_missing(table);
  if (known_bridge || !prior.weight.empty()) return prior;
  for (const int missing : prior.missing) {
    const auto number = std::min(static_cast<std::size_t>(missing), kBeliefInMissing.size() - 1);
    prior.weight.push_back(kBeliefInMissing[number]);
  }
  return prior;
}

std::vector<double> weights_of(const Prior& prior) {
  if (!prior.weight.empty() && prior.weight.size() != prior.missing.size())
    throw InputError(fmt::format("{} prior weights, expected {}: one for each number of missing blocks ({})",
                                 prior.weight.size(), prior.missing.size(), fmt::join(prior.missing, ", ")));
  if (!prior.weight.empty()) return prior.weight;
  std::vector<double> usual;
  for (const int missing : prior.missing) usual.push_back(missing == 0 ? kIntactWeight : 1.0);
  return usual;
}

std::vector<BlockId> likely_blocks(const Posterior& posterior, double least) {
  const auto probability = [&](BlockId id) {
    return posterior.block_probability[static_cast<std::size_t>(value(id))];
  };
  std::vector<BlockId> blocks;
  for (std::size_t i = 0; i < posterior.block_probability.size(); ++i)
    if (posterior.block_probability[i] >= least) blocks.push_back(BlockId{static_cast<std::int32_t>(i)});
  std::stable_sort(blocks.begin(), blocks.end(),
                   [&](BlockId a, BlockId b) { return probability(a) > probability(b); });
  return blocks;
}

double intact_probability(const Posterior& posterior) {
  return posterior.missing_probability.empty() ? 0.0 : posterior.missing_probability.front();
}

std::vector<double> log_prior_by_missing(const SceneTable& table, const Eligible& eligible,
                                         const Prior& prior) {
  const std::vector<double> weight = weights_of(prior);
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
  std::vector<double> result(table.most_missing + 1, kImpossible);
  for (std::size_t i = 0; i < prior.missing.size(); ++i) {
    const auto missing = static_cast<std::size_t>(prior.missing[i]);
    if (missing < result.size() && eligible.scenes[missing] > 0.0)
      result[missing] = std::log(weight[i] / total / eligible.scenes[missing]);
  }
  if (std::all_of(result.begin(), result.end(), [](double log) { return !std::isfinite(log); }))
    throw InputError(fmt::format(
        "prior weights {} for {} missing blocks leave no scene of the database possible, expected a "
        "positive weight for one of these numbers",
        fmt::join(weight, ", "), fmt::join(prior.missing, ", ")));
  return result;
}

Posterior posterior(const SceneTable& table, const Eligible& eligible, const RowValues& log_evidence,
                    const Prior& prior, std::size_t block_count) {
  const std::vector<double> log_prior = log_prior_by_missing(table, eligible, prior);
  Posterior result{{0.0, {}, {}},
                   std::vector<double>(block_count, 0.0),
                   std::vector<double>(table.most_missing + 1, 0.0),
                   {}};
  auto& [none, possible, weight] = result.probability;
  std::vector<std::size_t> missing;
  double best = kImpossible;
  for (std::size_t i = 0; i < log_evidence.rows.size(); ++i) {
    if (log_evidence.values[i] == kImpossible) continue;
    possible.push_back(log_evidence.rows[i]);
    missing.push_back(static_cast<std::size_t>(missing_blocks(table, possible.back())));
    weight.push_back(log_prior[missing.back()] + table.log_weight(possible.back()) + log_evidence.values[i]);
    best = std::max(best, weight.back());
  }
  if (best == kImpossible) {
    weight.assign(weight.size(), none);
    return result;
  }
  for (double& value : weight) value -= best;
  make_exponentials(weight);
  result.log_evidence = best + std::log(normalise(weight));
  for (std::size_t i = 0; i < possible.size(); ++i) {
    result.missing_probability[missing[i]] += weight[i];
    for (const std::int32_t id : table.removed.subspan(possible[i] * table.most_missing, table.most_missing))
      if (id >= 0) result.block_probability[static_cast<std::size_t>(id)] += weight[i];
  }
  for (auto* const sums : {&result.missing_probability, &result.block_probability})
    for (double& sum : *sums) sum = std::min(sum, 1.0);  // but for rounding they are
  result.intact_if_even = intact_if_even(result, table, eligible, log_prior);
  result.open_losses = open_losses(table, result.probability, log_prior);
  result.credible = credible_set(result.probability);
  return result;
}

}  // namespace voussoir
