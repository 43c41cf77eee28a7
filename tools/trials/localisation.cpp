#include "tools/trials/localisation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "lookup/readings/simulate.h"
#include "lookup/search/exhaustive_search.h"
#include "tools/trials/random_truth.h"

namespace voussoir {
namespace {

const Prior kEqual{{0, 1, 2}, {1.0, 1.0, 1.0}};  // as scenes are drawn
constexpr std::size_t kBins = 10;
constexpr std::size_t kFirstFew = 5;
constexpr double kLowestLevel = 0.01;  // of the noise in calibration and false alarms
constexpr double kHighestLevel = 0.20;
constexpr double kWorthCounting = 1e-3;  // probabilities below it do not enter the reliability table

void count_place(std::size_t place, Success& success) {
  ++success.trials;
  success.first += place == 0 ? 1 : 0;
  success.in_five += place < kFirstFew ? 1 : 0;
}

void count_genetic(const Library& library, const GeneSpace& space, const Measurements& measured,
                   std::size_t truth, const ScoredRow& minimum, std::uint64_t seed, CaseResult& result) {
  GeneticSettings settings;
  settings.seed = seed;
  const GeneticResult run = genetic_search(measured.displacement, library.table, space,
                                           missing_blocks(library.table, truth), settings, 1);
  result.genetic_minimum += run.best.front() == minimum ? 1 : 0;
  if (run.best.front().row != truth) return;
  ++result.genetic_found;
  result.generations.push_back(run.converged);
}

double draw_level(Random& random) {
  return kLowestLevel + (kHighestLevel - kLowestLevel) * random.uniform();
}

/// A scene with displacements whose number of missing blocks is 0, 1 or 2 with equal chances.
std::size_t draw_scene(const std::vector<Eligible>& by_missing, Random& random) {
  return random_truth(by_missing[random.below(static_cast<std::uint32_t>(by_missing.size()))], random);
}

}  // namespace

std::size_t row_of(const Library& library, const std::string& text) {
  const auto row = library.table.find(parse_scene(text, library.layout));
  if (!row) throw Failure(fmt::format("the database has no scene {}", text));
  expect_displacements(library, *row);
  return *row;
}

Posterior posterior_of(const Library& library, const Measurements& measured, const Eligible& eligible,
                       const NoiseModel& noise, const Prior& prior) {
  const Observation observation = observe(absolute_readings(library, measured), noise);
  return posterior(library.table, eligible, log_evidence_of_rows(observation, library.table, eligible.rows),
                   prior, library.layout.size());
}

std::size_t place_of(std::size_t truth, const Posterior& posterior) {
  const double of_truth = posterior.probability[truth];
  if (!(of_truth > 0.0)) return std::numeric_limits<std::size_t>::max();
  return static_cast<std::size_t>(
      std::ranges::count_if(posterior.probability.values, [&](double one) { return one > of_truth; }));
}

double held_by_exact_set(std::size_t truth, const Posterior& posterior) {
  double share = 0.0;
  for (const std::size_t row : posterior.credible) {
    const double probability = posterior.probability[row];
    if (row == truth) return std::min(1.0, (kCredibleShare - share) / probability);
    share += probability;
  }
  return 0.0;
}

void count_posterior(std::size_t truth, const Posterior& posterior, Success& success) {
  count_place(place_of(truth, posterior), success);
  const auto& set = posterior.credible;
  success.in_credible += std::find(set.begin(), set.end(), truth) != set.end() ? 1 : 0;
  success.in_exact += held_by_exact_set(truth, posterior);
}

std::vector<ScoredRow> best_by_misfit(const Library& library, const Measurements& measured,
                                      const Eligible& eligible) {
  return exhaustive_search(measured.displacement, library.table, eligible.rows, kFirstFew);
}

void count_misfit(std::size_t truth, const std::vector<ScoredRow>& best, Success& success) {
  const auto found =
      std::find_if(best.begin(), best.end(), [&](const ScoredRow& row) { return row.row == truth; });
  count_place(found == best.end() ? kFirstFew : static_cast<std::size_t>(found - best.begin()), success);
}

CaseResult run_case(const Library& library, const PaperCase& paper_case, int trials, std::uint64_t seed) {
  const std::size_t truth = row_of(library, paper_case.scene);
  const Prior prior{{missing_blocks(library.table, truth)}, {}};
  const Eligible eligible = eligible_rows(library.table, prior.missing);
  const GeneSpace space(library.layout, library.table);
  NoiseModel noise{NoiseShape::uniform, paper_case.noise};
  noise.silence = 0.0;  // in the paper every sensor reads
  CaseResult result;
  result.paper_case = paper_case;
  Random random(seed);
  for (int trial = 0; trial < trials; ++trial) {
    const Measurements measured = simulate_readings(library.table.row(truth), noise, random);
    const std::vector<ScoredRow> best = best_by_misfit(library, measured, eligible);
    count_misfit(truth, best, result.paper_objective);
    count_posterior(truth, posterior_of(library, measured, eligible, noise, prior), result.right_model);
    count_posterior(truth, posterior_of(library, measured, eligible, {}, prior), result.default_model);
    count_genetic(library, space, measured, truth, best.front(), static_cast<std::uint64_t>(trial) + 1,
                  result);
  }
  std::sort(result.generations.begin(), result.generations.end());
  return result;
}

std::vector<ReliabilityBin> unfinished_bins() {
  return std::vector<ReliabilityBin>(kBins);
}

void add_to_bins(const Posterior& posterior, std::size_t truth, std::vector<ReliabilityBin>& bins) {
  for (std::size_t i = 0; i < posterior.probability.rows.size(); ++i) {
    const double p = posterior.probability.values[i];
    if (p < kWorthCounting) continue;
    ReliabilityBin& bin = bins[std::min(kBins - 1, static_cast<std::size_t>(p * kBins))];
    ++bin.scenes;
    bin.mean_probability += p;
    bin.frequency += posterior.probability.rows[i] == truth ? 1.0 : 0.0;
    bin.standard_error += p * (1.0 - p);
  }
}

void add_finished(const std::vector<ReliabilityBin>& finished, std::vector<ReliabilityBin>& sum) {
  for (std::size_t i = 0; i < finished.size(); ++i) {
    const auto n = static_cast<double>(finished[i].scenes);
    sum[i].scenes += finished[i].scenes;
    sum[i].mean_probability += n * finished[i].mean_probability;
    sum[i].frequency += n * finished[i].frequency;
    sum[i].standard_error += std::pow(n * finished[i].standard_error, 2);
  }
}

void finish_bins(std::vector<ReliabilityBin>& bins) {
  for (ReliabilityBin& bin : bins) {
    const auto n = static_cast<double>(std::max<std::size_t>(1, bin.scenes));
    bin.mean_probability /= n;
    bin.frequency /= n;
    bin.standard_error = std::sqrt(bin.standard_error) / n;
  }
}

Calibration calibrate(const Library& library, NoiseShape drawn, NoiseShape assumed, bool stated, int trials,
                      std::uint64_t seed) {
  const Eligible all = eligible_rows(library.table, {0, 1, 2});
  const std::vector<Eligible> by_missing = {eligible_rows(library.table, {0}),
                                            eligible_rows(library.table, {1}),
                                            eligible_rows(library.table, {2})};
  Calibration result{{}, 0.0, unfinished_bins()};
  Random random(seed);
  for (int trial = 0; trial < trials; ++trial) {
    const std::size_t truth = draw_scene(by_missing, random);
    NoiseModel noise{drawn, draw_level(random)};
    const Measurements measured = simulate_readings(library.table.row(truth), noise, random);
    noise.shape = assumed;
    if (!stated) noise.relative.reset();
    const Posterior answer = posterior_of(library, measured, all, noise, kEqual);
    count_posterior(truth, answer, result.success);
    result.mean_set_size += static_cast<double>(answer.credible.size()) / trials;
    add_to_bins(answer, truth, result.bins);
  }
  finish_bins(result.bins);
  return result;
}

int false_alarms(const Library& library, bool known_noise, int trials, std::uint64_t seed) {
  const Eligible all = eligible_rows(library.table, {0, 1, 2});
  Random random(seed);
  int alarms = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const NoiseModel noise{NoiseShape::uniform, draw_level(random)};
    const Measurements measured = simulate_readings(library.table.row(0), noise, random);
    const Posterior answer = posterior_of(library, measured, all, known_noise ? noise : NoiseModel{}, kEqual);
    alarms += place_of(0, answer) > 0 ? 1 : 0;
  }
  return alarms;
}

}  // namespace voussoir
