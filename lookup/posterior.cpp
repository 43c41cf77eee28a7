#include "lookup/posterior.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// log prior of one scene with a given number of missing blocks: its number's weight over how many there are.
std::vector<double> log_prior_by_missing(const SceneTable& table, const Eligible& eligible, const Prior& prior) {
  if (!prior.weight.empty() && prior.weight.size() != prior.missing.size())
    throw InputError(fmt::format("{} prior weights, expected {}: one for each number of missing blocks",
                                 prior.weight.size(), prior.missing.size()));
  std::vector<double> scenes(table.most_missing + 1, 0.0);
  for (const std::size_t row : eligible.rows) ++scenes[static_cast<std::size_t>(missing_blocks(table, row))];
  std::vector<double> result(table.most_missing + 1, kImpossible);
  for (std::size_t i = 0; i < prior.missing.size(); ++i) {
    const auto missing = static_cast<std::size_t>(prior.missing[i]);
    const double weight = prior.weight.empty() ? 1.0 : prior.weight[i];
    if (missing < result.size() && scenes[missing] > 0.0) result[missing] = std::log(weight / scenes[missing]);
  }
  return result;
}

void normalise(std::vector<double>& probability) {
  const double total = std::accumulate(probability.begin(), probability.end(), 0.0);
  if (total > 0.0)
    for (double& value : probability) value /= total;
}

std::vector<std::size_t> credible_set(const std::vector<double>& probability) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < probability.size(); ++row)
    if (probability[row] > 0.0) rows.push_back(row);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return probability[a] > probability[b]; });
  double share = 0.0;
  std::size_t count = 0;
  while (count < rows.size() && share < kCredibleShare) share += probability[rows[count++]];
  rows.resize(count);
  return rows;
}

}  // namespace

int missing_blocks(const SceneTable& table, std::size_t row) {
  const auto removed = table.removed.subspan(row * table.most_missing, table.most_missing);
  return static_cast<int>(std::count_if(removed.begin(), removed.end(), [](std::int32_t id) { return id >= 0; }));
}

Eligible eligible_rows(const SceneTable& table, const std::vector<int>& missing) {
  Eligible result;
  for (std::size_t row = 0; row < table.rows; ++row) {
    if (std::find(missing.begin(), missing.end(), missing_blocks(table, row)) == missing.end()) continue;
    if (table.outcome[row] == static_cast<std::uint8_t>(Outcome::unresolved))
      ++result.unresolved;
    else
      result.rows.push_back(row);
  }
  return result;
}

Posterior posterior(const SceneTable& table, const Eligible& eligible, const std::vector<double>& log_evidence,
                    const Prior& prior, std::size_t block_count) {
  const std::vector<double> log_prior = log_prior_by_missing(table, eligible, prior);
  Posterior result{std::vector<double>(table.rows, 0.0), std::vector<double>(block_count, 0.0),
                   std::vector<double>(table.most_missing + 1, 0.0), {}};
  const auto log_weight = [&](std::size_t row) {
    return log_prior[static_cast<std::size_t>(missing_blocks(table, row))] + log_evidence[row];
  };
  double best = kImpossible;
  for (const std::size_t row : eligible.rows) best = std::max(best, log_weight(row));
  if (best == kImpossible) return result;
  for (const std::size_t row : eligible.rows)
    if (log_evidence[row] != kImpossible) result.probability[row] = std::exp(log_weight(row) - best);
  normalise(result.probability);
  for (const std::size_t row : eligible.rows) {
    if (result.probability[row] == 0.0) continue;
    result.missing_probability[static_cast<std::size_t>(missing_blocks(table, row))] += result.probability[row];
    for (const std::int32_t id : table.removed.subspan(row * table.most_missing, table.most_missing))
      if (id >= 0) result.block_probability[static_cast<std::size_t>(id)] += result.probability[row];
  }
  result.credible = credible_set(result.probability);
  return result;
}

}  // namespace voussoir
