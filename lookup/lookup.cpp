#include "lookup/lookup.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "lookup/evidence/posterior_screen.h"
#include "lookup/evidence/row_statistics.h"
#include "lookup/search/indexed_search.h"
#include "lookup/search/misfit.h"
#include "lookup/search/nearest_search.h"

namespace voussoir {
namespace {

/// Scenes whose predictions differ by less than this, as the root of the sum of squares in units of sigma,
/// are one scene to these sensors: even a hundred repeated measurements would hardly tell them apart.
constexpr double kSameReadings = 0.1;
constexpr double kSolverPrecision = 1e-9;      // [m] predictions are not compared more closely
constexpr std::size_t kMostComparisons = 500;  // rows looked at for scenes that cannot be told apart

std::string listed(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

std::size_t intact_row(const SceneTable& table) {
  for (std::size_t row = 0; row < table.rows; ++row)
    if (missing_blocks(table, row) == 0) return row;
  throw Failure("the database has no intact scene, which a lookup needs to know what can move");
}

Posterior posterior_of(const Library& library, const Measurements& measurements, const Eligible& eligible,
                       std::span<const double> intact, const LookupSettings& settings) {
  if (!settings.nuisance.any())
    return PosteriorScreen(library.table, library.index, eligible, settings.prior, library.layout.size())(
        measurements, intact, settings.noise, settings.top);
  const std::vector<double> evidence = log_evidence_with_nuisance(
      measurements, library.table, eligible.rows, intact, library.points, settings.noise, settings.nuisance);
  return posterior(library.table, eligible, evidence, settings.prior, library.layout.size());
}

std::vector<ScoredRow> run_genetic(const Library& library, const Measurements& measurements,
                                   const LookupSettings& settings, Answer& answer) {
  const GeneSpace space(library.layout, library.table);
  std::vector<ScoredRow> found;
  for (const int missing : settings.prior.missing) {
    if (missing == 0) {
      const std::size_t row = intact_row(library.table);
      found.push_back({row, sum_of_differences(measurements.displacement, library.table.row(row))});
      continue;
    }
    answer.genetic.push_back(genetic_search(measurements.displacement, library.table, space, missing,
                                            settings.genetic, settings.top));
    found.insert(found.end(), answer.genetic.back().best.begin(), answer.genetic.back().best.end());
  }
  return best_rows(std::move(found), settings.top);
}

std::vector<ScoredRow> scored_by_misfit(const Library& library, const Measurements& measurements,
                                        const Eligible& eligible, const LookupSettings& settings,
                                        Answer& answer) {
  switch (settings.search) {
    case Search::genetic:
      return run_genetic(library, measurements, settings, answer);
    case Search::nearest:
      return LinearIndex(library.table, eligible.rows, measurements.displacement)
          .search(measurements.displacement, settings.top);
    default:
      return IndexedSearch(library.table, library.index, library.points, eligible)
          .search(measurements.displacement, settings.top)
          .best;
  }
}

/// The likeliest rows; behind them, if fewer than `count` are possible, those with the smallest misfit.
std::vector<ScoredRow> scored_by_posterior(const Library& library, const Measurements& measurements,
                                           const Eligible& eligible, const Posterior& posterior,
                                           std::size_t count) {
  std::vector<std::size_t> likely;
  for (const std::size_t row : eligible.rows)
    if (posterior.probability[row] > 0.0) likely.push_back(row);
  const std::size_t kept = std::min(count, likely.size());
  std::partial_sort(likely.begin(), likely.begin() + static_cast<std::ptrdiff_t>(kept), likely.end(),
                    [&](std::size_t a, std::size_t b) {
                      const double pa = posterior.probability[a], pb = posterior.probability[b];
                      return pa != pb ? pa > pb : a < b;
                    });
  likely.resize(kept);
  std::vector<ScoredRow> result;
  for (const std::size_t row : likely)
    result.push_back({row, sum_of_differences(measurements.displacement, library.table.row(row))});
  if (kept == count) return result;
  const IndexedSearch search(library.table, library.index, library.points, eligible);
  for (const ScoredRow& row : search.search(measurements.displacement, count).best)
    if (result.size() < count && std::find(likely.begin(), likely.end(), row.row) == likely.end())
      result.push_back(row);
  return result;
}

/// The misfit search's candidates in the order of their posterior.
void order_by_posterior(std::vector<ScoredRow>& rows, const Posterior& posterior) {
  std::stable_sort(rows.begin(), rows.end(), [&](const ScoredRow& a, const ScoredRow& b) {
    return posterior.probability[a.row] > posterior.probability[b.row];
  });
}

bool same_readings(const Observation& observation, std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(observation.reading[i])) continue;
    const double scale = observation.slope[i] * std::abs(a[i]) + observation.offset[i];
    const double difference = (a[i] - b[i]) / std::max(scale, kSolverPrecision);
    sum += difference * difference;
  }
  return sum <= kSameReadings * kSameReadings;
}

std::vector<std::size_t> rows_to_compare(const std::vector<ScoredRow>& found, const Posterior& posterior) {
  std::vector<std::size_t> rows = posterior.credible;
  rows.resize(std::min(rows.size(), kMostComparisons));
  for (const ScoredRow& row : found)
    if (std::find(rows.begin(), rows.end(), row.row) == rows.end()) rows.push_back(row.row);
  return rows;
}

void judge_best(const Library& library, const Measurements& measurements, std::span<const double> intact,
                const std::vector<ScoredRow>& found, const LookupSettings& settings, Answer& answer) {
  const std::span<const double> best = library.table.row(found.front().row);
  answer.noise = estimate_noise(measurements, best, intact, settings.noise);
  const Observation observation =
      observe(measurements, intact, settings.noise, std::max(answer.noise->level, kSmallestLevel));
  const std::vector<double> errors = standard_errors(observation, best);
  answer.residuals = sensor_residuals(measurements, best, observation);
  const bool excluded = answer.posterior->probability[found.front().row] == 0.0;
  answer.fit =
      excluded ? Fit{false, 0.0,
                     answer.posterior->credible.empty() ? "every scene is excluded by at least one reading"
                                                        : "this scene is excluded by at least one reading"}
               : check_fit(errors, *answer.noise, settings.noise.degrees_of_freedom);
  const std::vector<std::size_t> others = rows_to_compare(found, *answer.posterior);
  for (Candidate& candidate : answer.candidates)
    for (const std::size_t other : others)
      if (other != candidate.row &&
          same_readings(observation, library.table.row(candidate.row), library.table.row(other)))
        candidate.same_readings.push_back(library.table.scene(other));
}

}  // namespace

Library library_of(const Database& database) {
  return {database.table(), database.control_points(), database.layout(), database.search_index()};
}

Answer locate_damage(const Library& library, const Measurements& measurements,
                     const LookupSettings& settings) {
  const Eligible eligible = eligible_rows(library.table, settings.prior.missing);
  if (eligible.rows.empty())
    throw Failure(fmt::format("the database has no solved scene with {} missing blocks",
                              listed(settings.prior.missing)));
  const std::span<const double> intact = library.table.row(intact_row(library.table));
  Answer answer;
  answer.readings = measurements.count();
  answer.searched = eligible.rows.size();
  answer.unresolved = eligible.unresolved;
  const bool by_posterior = settings.objective == Objective::posterior;
  if (by_posterior) answer.posterior = posterior_of(library, measurements, eligible, intact, settings);
  std::vector<ScoredRow> found;
  if (by_posterior && settings.search == Search::exhaustive) {
    found = scored_by_posterior(library, measurements, eligible, *answer.posterior, settings.top);
  } else {
    found = scored_by_misfit(library, measurements, eligible, settings, answer);
    if (by_posterior) order_by_posterior(found, *answer.posterior);
  }
  for (const ScoredRow& row : found) {
    Candidate candidate{row.row,
                        library.table.scene(row.row),
                        static_cast<Outcome>(library.table.outcome[row.row]),
                        misfit_of(row.sum),
                        std::nullopt,
                        {}};
    if (by_posterior) candidate.posterior = answer.posterior->probability[row.row];
    answer.candidates.push_back(std::move(candidate));
  }
  if (by_posterior && !found.empty()) judge_best(library, measurements, intact, found, settings, answer);
  return answer;
}

}  // namespace voussoir
