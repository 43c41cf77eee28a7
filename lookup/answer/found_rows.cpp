#include "lookup/answer/found_rows.h"

#include <algorithm>
#include <span>

#include "lookup/evidence/largest_places.h"
#include "lookup/search/misfit.h"
#include "lookup/search/nearest_search.h"

namespace voussoir {
namespace {

FoundRows run_genetic(const Library& library, const Observation& observation, const Prior& prior,
                      const LookupSettings& settings) {
  const GeneSpace space(library.layout, library.table);
  const std::size_t count = rows_wanted(settings);
  FoundRows found;
  for (const int missing : prior.missing) {
    if (missing == 0) {
      found.rows.push_back({0, sum_of_differences(observation.displacement, library.table.row(0))});
      continue;
    }
    found.genetic.push_back(
        genetic_search(observation.displacement, library.table, space, missing, settings.genetic, count));
    const std::vector<ScoredRow>& best = found.genetic.back().best;
    found.rows.insert(found.rows.end(), best.begin(), best.end());
  }
  found.rows = best_rows(std::move(found.rows), count);
  return found;
}

FoundRows found_by_misfit(const Library& library, const Observation& observation,
                          const Preparation& preparation, const LookupSettings& settings) {
  const std::size_t count = rows_wanted(settings);
  switch (settings.search) {
    case Search::genetic:
      return run_genetic(library, observation, preparation.prior(), settings);
    case Search::nearest:
      return {LinearIndex(library.table, preparation.eligible().rows, observation.displacement)
                  .search(observation.displacement, count)};
    default:
      return {preparation.smallest_misfits(observation, count)};
  }
}

/// The likeliest rows; behind them, if fewer than `count` are possible, those with the smallest misfit.
std::vector<ScoredRow> likeliest_rows(const Library& library, const Observation& observation,
                                      const Preparation& preparation, const Posterior& posterior,
                                      std::size_t count) {
  std::vector<std::size_t> likely;
  for (const std::size_t place : largest_places(posterior.probability.values, count))
    if (posterior.probability.values[place] > 0.0) likely.push_back(posterior.probability.rows[place]);
  std::vector<ScoredRow> result;
  for (const std::size_t row : likely)
    result.push_back({row, sum_of_differences(observation.displacement, library.table.row(row))});
  if (result.size() == count) return result;
  for (const ScoredRow& row : preparation.smallest_misfits(observation, count))
    if (result.size() < count && std::find(likely.begin(), likely.end(), row.row) == likely.end())
      result.push_back(row);
  return result;
}

/// The misfit search's candidates in the order of their posterior.
void order_by_posterior(std::span<ScoredRow> rows, const Posterior& posterior) {
  std::stable_sort(rows.begin(), rows.end(), [&](const ScoredRow& a, const ScoredRow& b) {
    return posterior.probability[a.row] > posterior.probability[b.row];
  });
}

}  // namespace

std::size_t rows_wanted(const LookupSettings& settings) {
  return std::max(settings.top, kBestCompared);
}

FoundRows found_rows(const Library& library, const Observation& observation, const Preparation& preparation,
                     const LookupSettings& settings, const std::optional<Posterior>& posterior) {
  const bool likeliest = posterior && settings.search == Search::exhaustive;
  FoundRows found =
      likeliest
          ? FoundRows{likeliest_rows(library, observation, preparation, *posterior, rows_wanted(settings))}
          : found_by_misfit(library, observation, preparation, settings);
  found.candidates = std::min(found.rows.size(), settings.top);
  if (posterior && !likeliest) order_by_posterior(std::span(found.rows).first(found.candidates), *posterior);
  return found;
}

}  // namespace voussoir
