#include "lookup/lookup.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "lookup/answer/answerable_questions.h"
#include "lookup/answer/found_rows.h"
#include "lookup/checks/fewer_readings.h"
#include "lookup/checks/judgement.h"
#include "lookup/checks/plausible_readings.h"
#include "lookup/checks/same_readings.h"
#include "lookup/search/misfit.h"

namespace voussoir {
namespace {

// Credible rows looked at for scenes that cannot be told apart, which takes time for each candidate. Chosen,
// not tuned.
constexpr std::size_t kMostComparisons = 500;

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

/// Of every scene.
UnknownEvidence evidence_of_scenes(const std::optional<UnknownBridgeQuestion>& question,
                                   const Observation& observation, const Preparation& preparation,
                                   const LookupSettings& settings) {
  const std::size_t count = rows_wanted(settings);
  if (!question) return {preparation.screen()(observation, count), {}};
  return question->evidence(preparation.eligible(), preparation.prior(), count);
}

Candidate candidate_of(const Library& library, const ScoredRow& found,
                       const std::optional<Posterior>& posterior) {
  Candidate candidate{found.row,
                      library.table.scene(found.row),
                      static_cast<Outcome>(library.table.outcome[found.row]),
                      std::nullopt,
                      misfit_of(found.sum),
                      std::nullopt,
                      {}};
  if (library.table.is_uncertain_fall(found.row))
    candidate.standing_share = library.table.standing_share[found.row];
  if (posterior) candidate.posterior = posterior->probability[found.row];
  return candidate;
}

std::vector<Candidate> candidates_of(const Library& library, const FoundRows& found,
                                     const std::optional<Posterior>& posterior) {
  std::vector<Candidate> candidates;
  for (const ScoredRow& row : std::span(found.rows).first(found.candidates))
    candidates.push_back(candidate_of(library, row, posterior));
  return candidates;
}

/// The credible rows and the best.
std::vector<std::size_t> rows_to_compare(const FoundRows& found, const Posterior& posterior) {
  std::vector<std::size_t> rows = posterior.credible;
  rows.resize(std::min(rows.size(), kMostComparisons));
  for (const ScoredRow& row : std::span(found.rows).first(std::min(found.rows.size(), kBestCompared)))
    if (std::find(rows.begin(), rows.end(), row.row) == rows.end()) rows.push_back(row.row);
  return rows;
}

/// With what cannot be told from each of them by these sensors.
std::vector<Candidate> with_same_readings(std::vector<Candidate> candidates, const Library& library,
                                          const Observation& observation, double level,
                                          const std::vector<std::size_t>& others) {
  const ErrorScales scales = scales_at(observation, std::max(level, kSmallestLevel));
  for (Candidate& candidate : candidates)
    for (const std::size_t row : same_readings(observation, scales, library.table, candidate.row, others))
      candidate.same_readings.push_back(library.table.scene(row));
  return candidates;
}

/// By the readings as they are.
Answer answer_to(const Comparison& comparison, const LookupSettings& settings,
                 const Preparation& preparation) {
  const Library& library = comparison.library;
  const bool known = counts_as_known(comparison, settings);
  const Observation observation =
      observe(comparison, known ? settings.noise : gaussian_noise(settings.noise), settings.nuisance);
  require_answerable(comparison, settings, observation);
  Answer answer = answer_without_candidates(comparison, observation, preparation, known);
  const UnknownSettings unknown{settings.epochs, settings.conditions, settings.nuisance.scale};
  std::optional<UnknownBridgeQuestion> question;
  if (!known) question.emplace(comparison, observation, unknown);
  UnknownEvidence evidence{};
  if (settings.objective == Objective::posterior) {
    evidence = evidence_of_scenes(question, observation, preparation, settings);
    answer.posterior = posterior(library.table, preparation.eligible(), evidence.logs, preparation.prior(),
                                 library.layout.size());
  }
  FoundRows found = found_rows(library, observation, preparation, settings, answer.posterior);
  answer.candidates = candidates_of(library, found, answer.posterior);
  answer.genetic = std::move(found.genetic);
  if (!answer.posterior || found.rows.empty()) return answer;
  const AskedReadings asked{comparison, observation, preparation, *answer.posterior};
  Judgement judgement = question ? judge_unknown_bridge(asked, *question, unknown, evidence.likeliest)
                                 : judge_known_bridge(asked, found.rows.front().row);
  const std::optional<Fit> doubt = check_readings(comparison, observation);
  answer.noise = judgement.noise;
  answer.fit = doubt ? *doubt : std::move(judgement.fit);
  answer.residuals = std::move(judgement.residuals);
  answer.bridge = std::move(judgement.bridge);
  answer.candidates = with_same_readings(std::move(answer.candidates), library, observation,
                                         judgement.noise.level, rows_to_compare(found, *answer.posterior));
  return answer;
}

/// The answer without readings that may be wrong, if the others are explained then; of several such without
/// those without which they fit best.
std::optional<AnswerWithout> answer_without_suspects(const Comparison& comparison,
                                                     const LookupSettings& settings,
                                                     const Preparation& preparation, const Answer& answer) {
  std::optional<AnswerWithout> best;
  for (std::vector<std::size_t>& suspects : suspects_of(answer)) {
    if (suspects.size() >= answer.readings) continue;
    auto other =
        std::make_shared<Answer>(answer_to(without_readings(comparison, suspects), settings, preparation));
    if (!other->fit || !other->fit->explained) continue;
    if (!best || other->fit->chance > best->answer->fit->chance)
      best = {std::move(suspects), std::move(other)};
  }
  return best;
}

}  // namespace

Answer locate_damage(const Comparison& comparison, const LookupSettings& settings) {
  return locate_damage(comparison, settings,
                       Preparation(comparison.library, settings, counts_as_known(comparison, settings)));
}

Answer locate_damage(const Comparison& comparison, const LookupSettings& settings,
                     const Preparation& preparation) {
  Answer answer = answer_to(comparison, settings, preparation);
  answer.without = answer_without_suspects(comparison, settings, preparation, answer);
  answer.residuals = told_residuals(answer);
  return answer;
}

}  // namespace voussoir
