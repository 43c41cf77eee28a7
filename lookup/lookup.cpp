#include "lookup/lookup.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "lookup/checks/fewer_readings.h"
#include "lookup/checks/lines_and_loads.h"
#include "lookup/checks/other_explanations.h"
#include "lookup/checks/plausible_readings.h"
#include "lookup/checks/same_readings.h"
#include "lookup/checks/turned_readings.h"
#include "lookup/evidence/largest_places.h"
#include "lookup/search/exhaustive_search.h"
#include "lookup/search/misfit.h"
#include "lookup/search/nearest_search.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostChecked = 20;       // scenes whose fit is checked
constexpr std::size_t kMostMixed = 3;          // scenes that say together what the bridge is like
constexpr std::size_t kMostComparisons = 500;  // rows looked at for scenes that cannot be told apart:
constexpr std::size_t kBestCompared = 10;      // the credible ones and so many of the best

std::vector<ScoredRow> run_genetic(const Library& library, const Observation& observation,
                                   const LookupSettings& settings, Answer& answer) {
  const GeneSpace space(library.layout, library.table);
  std::vector<ScoredRow> found;
  for (const int missing : answer.prior.missing) {
    if (missing == 0) {
      found.push_back({0, sum_of_differences(observation.displacement, library.table.row(0))});
      continue;
    }
    answer.genetic.push_back(genetic_search(observation.displacement, library.table, space, missing,
                                            settings.genetic, settings.top));
    found.insert(found.end(), answer.genetic.back().best.begin(), answer.genetic.back().best.end());
  }
  return best_rows(std::move(found), settings.top);
}

std::vector<ScoredRow> scored_by_misfit(const Library& library, const Observation& observation,
                                        const Preparation& preparation, const LookupSettings& settings,
                                        Answer& answer) {
  switch (settings.search) {
    case Search::genetic:
      return run_genetic(library, observation, settings, answer);
    case Search::nearest:
      return LinearIndex(library.table, preparation.eligible().rows, observation.displacement)
          .search(observation.displacement, settings.top);
    default:
      return preparation.smallest_misfits(observation, settings.top);
  }
}

/// The likeliest rows; behind them, if fewer than `count` are possible, those with the smallest misfit.
std::vector<ScoredRow> scored_by_posterior(const Library& library, const Observation& observation,
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

std::vector<std::size_t> rows_to_compare(const std::vector<ScoredRow>& found, const Posterior& posterior) {
  std::vector<std::size_t> rows = posterior.credible;
  rows.resize(std::min(rows.size(), kMostComparisons));
  for (const ScoredRow& row : std::span(found).first(std::min(found.size(), kBestCompared)))
    if (std::find(rows.begin(), rows.end(), row.row) == rows.end()) rows.push_back(row.row);
  return rows;
}

/// The predictive check: how likely a fit as bad as this is, on average over the likeliest scenes.
Fit fit_of(const Library& library, const Observation& observation, const Answer& answer) {
  const Posterior& posterior = *answer.posterior;
  if (posterior.credible.empty()) return {false, 0.0, "every scene is excluded by at least one reading"};
  std::optional<Fit> likeliest;
  double chance = 0.0, weight = 0.0;
  for (const std::size_t row :
       std::span(posterior.credible).first(std::min(posterior.credible.size(), kMostChecked))) {
    const Fit checked = check_fit(observation, *answer.noise, library.table.row(row));
    const double share = posterior.probability[row];
    chance += share * checked.chance;
    weight += share;
    if (!likeliest) likeliest = checked;
  }
  Fit fit = *likeliest;
  fit.chance = chance / weight;
  fit.explained = fit.chance >= kSmallestChance;
  if (fit.explained) fit.reason.clear();
  return fit;
}

/// What cannot be told from the candidates by these sensors.
void add_same_readings(const Library& library, const Observation& observation,
                       const std::vector<ScoredRow>& found, Answer& answer) {
  const ErrorScales scales = scales_at(observation, std::max(answer.noise->level, kSmallestLevel));
  const std::vector<std::size_t> others = rows_to_compare(found, *answer.posterior);
  for (Candidate& candidate : answer.candidates)
    for (const std::size_t row : same_readings(observation, scales, library.table, candidate.row, others))
      candidate.same_readings.push_back(library.table.scene(row));
}

/// The noise, the fit and the residuals if the best candidate is the truth.
void judge_known_bridge(const Comparison& comparison, const Observation& observation,
                        const Preparation& preparation, std::size_t best, Answer& answer) {
  const std::span<const double> prediction = comparison.library.table.row(best);
  answer.noise = estimate_noise(observation, prediction);
  answer.residuals = sensor_residuals(
      observation, scales_at(observation, std::max(answer.noise->level, kSmallestLevel)), prediction);
  answer.fit = fit_of(comparison.library, observation, answer);
  answer.fit->suspects = suspects_among(answer.residuals);
  if (const auto doubt = check_signs(comparison, observation, preparation, answer)) answer.fit = doubt;
}

/// A fit that explains nothing names what nobody stated and would explain the readings, unless one of them
/// disagrees with all others (ask_without).
void name_cause(const QuestionContext& asked, Answer& answer) {
  const bool one_disagrees = std::ranges::any_of(answer.residuals, &SensorResidual::disagrees);
  if (one_disagrees) return;
  if (const auto cause = line_or_load_that_explains(asked)) answer.fit->reason += "; " + *cause;
}

/// The same, and what the readings say of the bridge, averaged over the likeliest scenes.
void judge_unknown_bridge(const QuestionContext& asked, Answer& answer) {
  const Observation& observation = asked.observation;
  answer.noise = {NoiseShape::gaussian, asked.likeliest.level, observation.unknown_level,
                  observation.noise.floor};
  answer.fit = {false, 0.0, "no scene can show them: each lacks a block that has a reading, or fell"};
  std::vector<WeightedScene> scenes;
  for (const std::size_t row : answer.posterior->credible)
    if (scenes.size() < kMostMixed) scenes.push_back({row, answer.posterior->probability[row]});
  if (scenes.empty()) return;
  const UnknownBridge& bridge = asked.question.bridge();
  answer.bridge = {bridge, asked.question.posterior(scenes)};
  answer.fit = check_fit(answer.bridge->posterior);
  answer.residuals = sensor_residuals(observation, bridge, case_noise(bridge, observation, asked.likeliest),
                                      answer.bridge->posterior);
  answer.fit->suspects = suspects_among(answer.residuals);
  if (!answer.fit->explained) name_cause(asked, answer);
  if (answer.fit->explained)
    if (const auto doubt = check_scatter(bridge, answer.bridge->posterior)) answer.fit = doubt;
  if (answer.fit->explained)
    if (const auto doubt = find_other(asked, answer)) answer.fit = doubt;
}

/// What scenes are compared with must not depend on how many are listed.
LookupSettings with_compared(LookupSettings settings) {
  settings.top = std::max(settings.top, kBestCompared);
  return settings;
}

/// Of found rows those that become candidates.
std::span<ScoredRow> listed(std::vector<ScoredRow>& found, const LookupSettings& settings) {
  return std::span(found).first(std::min(found.size(), settings.top));
}

/// The candidates' rows, best first, and behind them those that they are compared with beside.
std::vector<ScoredRow> found_rows(const Library& library, const Observation& observation,
                                  const Preparation& preparation, const LookupSettings& settings,
                                  Answer& answer) {
  const LookupSettings wider = with_compared(settings);
  if (answer.posterior && settings.search == Search::exhaustive)
    return scored_by_posterior(library, observation, preparation, *answer.posterior, wider.top);
  std::vector<ScoredRow> found = scored_by_misfit(library, observation, preparation, wider, answer);
  if (answer.posterior) order_by_posterior(listed(found, settings), *answer.posterior);
  return found;
}

Candidate candidate_of(const Library& library, const ScoredRow& found,
                       const std::optional<Posterior>& posterior) {
  Candidate candidate{found.row,
                      library.table.scene(found.row),
                      static_cast<Outcome>(library.table.outcome[found.row]),
                      misfit_of(found.sum),
                      std::nullopt,
                      {}};
  if (posterior) candidate.posterior = posterior->probability[found.row];
  return candidate;
}

/// Sampled bridges show the directions that they took, and nothing of temperature and supports: only what
/// changes is small against its errors in all others.
void require_known_scatter(const Comparison& comparison, const LookupSettings& settings) {
  if (!comparison.sampled || comparison.sampled->has_first_order) return;
  constexpr const char* kRemedy = "or a database with sensitivities (build-database without --known-bridge)";
  if (settings.conditions == Conditions::uncertain)
    throw InputError(
        fmt::format("evidence from variants: this database says nothing of temperature and "
                    "supports, expected --conditions known, {}",
                    kRemedy));
  if (!is_change(comparison.kind) || settings.epochs == Epochs::both)
    throw InputError(
        fmt::format("evidence from variants: {} sampled bridges leave out most of what an "
                    "intact bridge can be, expected changes (--epochs change), {}",
                    comparison.sampled->count, kRemedy));
}

/// Where nothing changed a share of the change is an error of zero, and any scatter would be damage.
void require_stated_errors(const Comparison& comparison, const Observation& observation) {
  if (!is_change(comparison.kind) || !observation.unknown_level) return;
  const std::vector<std::size_t> channels = observation.channels_read();
  const auto without =
      std::ranges::find_if_not(channels, [&](std::size_t i) { return observation.floor[i] > 0.0; });
  if (without == channels.end()) return;
  throw InputError(fmt::format(
      "a change without an error (at {}), expected a column sigma_mm or --sigma 0.02mm: a share of what "
      "has not changed is none",
      comparison.library.points[*without].name));
}

/// The first of two epochs teaches what a bridge is like that is not exactly known.
void require_two_epochs(const Comparison& comparison, bool known) {
  if (comparison.before.empty())
    throw InputError("both epochs are to count, expected readings with before_mm and after_mm");
  for (std::size_t i = 0; i < comparison.before.size(); ++i)
    if (std::abs(comparison.before[i]) > kLargestDisplacement)
      throw InputError(
          fmt::format("both epochs are to count, expected displacements since the bridge carried nothing, "
                      "{} was at {:.6g} m before: heights above a datum show changes only",
                      comparison.library.points[i].name, comparison.before[i]));
  if (known)
    throw InputError(
        "both epochs are to count, expected a bridge that is not exactly known: a database with "
        "sensitivities, without --known-bridge");
}

void require_answerable(const Comparison& comparison, const LookupSettings& settings,
                        const Observation& observation) {
  const bool known = counts_as_known(comparison, settings);
  if (settings.epochs == Epochs::both) require_two_epochs(comparison, known);
  if (!known) require_known_scatter(comparison, settings);
  if (settings.objective == Objective::posterior) require_stated_errors(comparison, observation);
}

/// What it is an answer to.
Answer answer_without_candidates(const Comparison& comparison, const Observation& observation,
                                 const Preparation& preparation, bool known) {
  Answer answer;
  answer.known_bridge = known;
  answer.prior = preparation.prior();
  answer.readings = comparison.measured.count();
  answer.counted = observation.channels_read();
  answer.searched = preparation.eligible().rows.size();
  answer.unresolved = preparation.eligible().unresolved;
  const std::vector<std::size_t>& fallen = preparation.eligible().fallen;
  answer.fallen = std::reduce(fallen.begin(), fallen.end());
  return answer;
}

/// By the readings as they are.
Answer answer_to(const Comparison& comparison, const LookupSettings& settings,
                 const Preparation& preparation) {
  const Library& library = comparison.library;
  const bool known = counts_as_known(comparison, settings);
  const Eligible& eligible = preparation.eligible();
  const Observation observation =
      observe(comparison, known ? settings.noise : gaussian_noise(settings.noise), settings.nuisance);
  Answer answer = answer_without_candidates(comparison, observation, preparation, known);
  require_answerable(comparison, settings, observation);
  const UnknownSettings unknown{settings.epochs, settings.conditions, settings.nuisance.scale};
  std::optional<UnknownBridgeQuestion> question;
  if (!known) question.emplace(comparison, observation, unknown);
  UnknownCase likeliest;
  if (settings.objective == Objective::posterior) {
    const std::size_t count = with_compared(settings).top;
    const UnknownEvidence evidence = question ? question->evidence(eligible, answer.prior, count)
                                              : UnknownEvidence{preparation.screen()(observation, count), {}};
    answer.posterior = posterior(library.table, eligible, evidence.logs, answer.prior, library.layout.size());
    likeliest = evidence.likeliest;
  }
  std::vector<ScoredRow> found = found_rows(library, observation, preparation, settings, answer);
  for (const ScoredRow& row : listed(found, settings))
    answer.candidates.push_back(candidate_of(library, row, answer.posterior));
  if (!answer.posterior || found.empty()) return answer;
  if (question)
    judge_unknown_bridge({*question, likeliest, question->gaussians_at(likeliest.level), unknown, comparison,
                          observation, preparation},
                         answer);
  else
    judge_known_bridge(comparison, observation, preparation, found.front().row, answer);
  if (const auto doubt = check_readings(comparison, observation)) answer.fit = doubt;
  add_same_readings(library, observation, found, answer);
  return answer;
}

/// Asks again without readings that may be wrong, if the others are explained then; of several such the ones
/// without which they fit best.
void ask_without(const Comparison& comparison, const LookupSettings& settings, const Preparation& preparation,
                 Answer& answer) {
  for (std::vector<std::size_t>& suspects : suspects_of(answer)) {
    if (suspects.size() >= answer.readings) continue;
    auto other =
        std::make_shared<Answer>(answer_to(without_readings(comparison, suspects), settings, preparation));
    if (!other->fit || !other->fit->explained) continue;
    if (!answer.without || other->fit->chance > answer.without->answer->fit->chance)
      answer.without = {std::move(suspects), std::move(other)};
  }
}

}  // namespace

Answer locate_damage(const Comparison& comparison, const LookupSettings& settings) {
  return locate_damage(comparison, settings,
                       Preparation(comparison.library, settings, counts_as_known(comparison, settings)));
}

Answer locate_damage(const Comparison& comparison, const LookupSettings& settings,
                     const Preparation& preparation) {
  Answer answer = answer_to(comparison, settings, preparation);
  ask_without(comparison, settings, preparation, answer);
  return answer;
}

}  // namespace voussoir
