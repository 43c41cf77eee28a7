/// @file Questions about a bridge that is not exactly known, made up at random. Oracle: the evidence of every
/// scene in every case, worked out one by one.

#include "lookup/unknown/unknown_question.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "core/random.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/scene_evidence.h"
#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A made-up bridge and readings of it.
struct Trial {
  SyntheticLibrary library;
  Sensitivities sensitivities;
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  Trial(int courses, int length, Index columns, double size, int most_missing = 2)
      : library(courses, length, most_missing),
        sensitivities(made_up_sensitivities_of(library, columns, size)) {
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.02, {}};
  }

  /// With parameters of the bridge and errors drawn at random.
  void measure(ReadingKind kind, std::size_t truth, double sigma, Random& random) {
    comparison.kind = kind;
    const ReadingFactors& factors = *comparison.factors;
    Eigen::VectorXd theta(factors.of_bridge());
    for (double& one : theta) one = random.gaussian();
    const Eigen::VectorXd after = factors.of(library.table.scene(truth)).bridge * theta,
                          before = factors.intact.bridge * theta;
    comparison.before.clear();
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      const auto at = static_cast<Index>(i);
      const double shown = library.table.row(truth)[i] + sigma * random.gaussian() + after[at];
      if (is_change(kind))
        comparison.before.push_back(library.intact()[i] + before[at] +
                                    sigma / std::sqrt(2.0) * random.gaussian());
      comparison.measured.displacement[i] = is_change(kind) ? shown - before[at] : shown;
      comparison.measured.sigma[i] = sigma;
      comparison.measured.silent[i] = std::isnan(shown);
    }
  }
  void forget_sigmas() { comparison.measured.sigma.assign(library.points.size(), kUnknown); }
};

struct Asked {
  NoiseModel noise{NoiseShape::gaussian, 0.0};
  Nuisance nuisance{};
  UnknownSettings settings{};
  Prior prior{};
};

/// As docs/uncertainty.md states the cases.
std::vector<UnknownCase> all_cases(const Observation& observation, Conditions conditions) {
  std::vector<double> levels = {observation.noise.relative.value_or(0.0)};
  if (observation.unknown_level) levels = {.001, .002, .004, .008, .016, .032, .064, .128, .256};
  std::vector<UnknownCase> cases;
  for (const double level : levels) {
    if (conditions == Conditions::known) cases.push_back({level, 0.0});
    if (conditions == Conditions::uncertain)
      for (const double size : {0.03, 0.3, 0.8, 1.0, 3.0}) cases.push_back({level, size});
  }
  return cases;
}

std::vector<double> brute_force(const Trial& trial, const Observation& observation, const Asked& asked,
                                const Eligible& eligible) {
  const SceneTable& table = trial.library.table;
  const std::vector<UnknownCase> cases = all_cases(observation, asked.settings.conditions);
  const UnknownBridge bridge = unknown_bridge(trial.comparison, observation, asked.settings);
  const auto silence = log_chance_of_silence(observation, table, eligible.rows);
  std::vector<double> logs(table.rows, -std::numeric_limits<double>::infinity());
  for (const UnknownCase& one : cases) {
    const CaseNoise noise = case_noise(bridge, observation, one);
    const auto of_case = scatter_logs(bridge, noise, observation, table, eligible.rows, 2);
    for (std::size_t i = 0; i < eligible.rows.size(); ++i)
      logs[eligible.rows[i]] = log_sum(logs[eligible.rows[i]], over_scatter(of_case[i]) + silence[i]);
  }
  for (double& log : logs) log -= std::log(static_cast<double>(cases.size()));
  return logs;
}

/// The largest difference of any scene's, block's or number's probability.
double largest_difference(const Trial& trial, Asked asked) {
  const SceneTable& table = trial.library.table;
  asked.prior = stated_prior(asked.prior, table, false);
  const Eligible eligible = eligible_rows(table, asked.prior.missing);
  const Observation observation = observe(trial.comparison, asked.noise, asked.nuisance);
  const UnknownBridgeQuestion question(trial.comparison, observation, asked.settings);
  const auto posterior_of = [&](const RowValues& logs) {
    return posterior(table, eligible, logs, asked.prior, trial.library.blocks);
  };
  const Posterior found = posterior_of(question.evidence(eligible, asked.prior, 10).logs);
  const Posterior wanted =
      posterior_of({kImpossible, all_rows(table), brute_force(trial, observation, asked, eligible)});
  double worst = 0.0;
  const auto compare_numbers = [&](double a, double b) {
    const double off = std::abs(a - b);
    worst = std::max(worst, std::isnan(off) ? std::numeric_limits<double>::infinity() : off);
  };
  const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) compare_numbers(a[i], b[i]);
  };
  for (std::size_t row = 0; row < table.rows; ++row)
    compare_numbers(found.probability[row], wanted.probability[row]);
  compare(found.block_probability, wanted.block_probability);
  compare(found.missing_probability, wanted.missing_probability);
  return worst;
}

double between(double least, double most, Random& random) {
  return least * std::pow(most / least, random.uniform());
}

bool one_in(std::uint32_t many, Random& random) {
  return random.below(many) == 0;
}

/// Any of the questions that a bridge which is not known may be asked.
Asked random_question(std::unique_ptr<Trial>& trial, Random& random, int most_missing) {
  const int longest = most_missing > 2 ? 4 : 9;  // triples are many
  trial = std::make_unique<Trial>(2 + static_cast<int>(random.below(3)),
                                  4 + static_cast<int>(random.below(static_cast<std::uint32_t>(longest))),
                                  3 + random.below(30), between(3e-6, 3e-4, random), most_missing);
  const SceneTable& table = trial->library.table;
  const bool change = one_in(2, random);
  std::size_t truth = one_in(3, random) ? 0 : random.below(static_cast<std::uint32_t>(table.rows));
  if (table.outcome[truth] != 0) truth = 0;
  trial->measure(change ? ReadingKind::change : ReadingKind::absolute, truth, between(1e-6, 1e-3, random),
                 random);
  for (std::size_t i = 0; i < trial->library.points.size(); ++i)
    if (one_in(12, random)) {
      trial->comparison.measured.displacement[i] = kUnknown;
      trial->comparison.measured.silent[i] = one_in(2, random);
    }
  Asked asked;
  const bool stated = one_in(2, random);
  if (!stated) {
    trial->forget_sigmas();
    asked.noise.relative.reset();
    if (one_in(3, random)) asked.noise.relative = between(1e-3, 0.3, random);
    if (one_in(3, random)) asked.noise.floor = between(1e-6, 1e-4, random);
  }
  if (one_in(3, random)) asked.nuisance.datum = between(1e-5, 1e-3, random);
  if (one_in(4, random)) asked.nuisance.tilt = between(1e-6, 1e-4, random);
  if (one_in(4, random)) asked.nuisance.scale = between(0.01, 0.3, random);
  if (change && one_in(2, random)) asked.settings.epochs = Epochs::both;
  if (one_in(3, random)) asked.settings.conditions = Conditions::known;
  if (one_in(4, random)) {
    asked.prior = stated_prior({}, table, true);
    asked.prior.weight.assign(asked.prior.missing.size(), 1.0);
  }
  if (one_in(6, random)) asked.prior = {{1, 2}, {1.0, 1.0}};
  return asked;
}

/// Of so many questions. As long as few scenes are likely a probability is off by a thousandth at most; of
/// more than four hundred the others are estimated, and together they may be off by this.
constexpr double kMostOff = 0.02;

void check_random_questions(std::uint64_t seed, int questions, int most_missing = 2) {
  int exact = 0;
  for (int i = 0; i < questions; ++i) {
    Random random(series_seed(seed, static_cast<std::uint64_t>(i)));
    std::unique_ptr<Trial> trial;
    const Asked asked = random_question(trial, random, most_missing);
    const double off = largest_difference(*trial, asked);
    INFO("question " << i << " of seed " << seed);
    CHECK(off < kMostOff);
    if (off < 1e-3) ++exact;
  }
  CHECK(exact >= questions * 95 / 100);
}

}  // namespace

TEST_CASE("What the screen leaves out or estimates changes no probability by more than a thousandth") {
  Trial trial(4, 6, 8, 3e-5);
  Random random(5);
  const SceneTable& table = trial.library.table;
  for (const ReadingKind kind : {ReadingKind::absolute, ReadingKind::change})
    for (const double sigma : {3e-6, 3e-5, 3e-4})
      for (int repeat = 0; repeat < 4; ++repeat) {
        const std::size_t truth =
            repeat == 0 ? 0 : std::size_t{random.below(static_cast<std::uint32_t>(table.rows))};
        trial.measure(kind, table.outcome[truth] == 0 ? truth : 0, sigma, random);
        CHECK(largest_difference(trial, {.settings = {.conditions = Conditions::known}}) < 1e-3);
      }
}

TEST_CASE("So is it where some scenes fall as the file says, but may stand") {
  Random random(23);
  for (const ReadingKind kind : {ReadingKind::absolute, ReadingKind::change}) {
    Trial trial(4, 4, 5, 2e-4);
    SceneTable& table = trial.library.table;
    std::vector<double> share(table.rows, 0.0);
    for (const std::size_t row : {std::size_t{3}, std::size_t{6}, std::size_t{40}}) {
      trial.library.outcome[row] = static_cast<std::uint8_t>(Outcome::collapsed);
      share[row] = 0.125;
    }
    table.standing_share = share;
    trial.comparison.library.table = table;
    trial.measure(kind, 6, 1e-5, random);
    CHECK(largest_difference(trial, {}) < 1e-3);
  }
}

TEST_CASE("Cases that are not looked at change no probability by more than a thousandth") {
  Trial trial(4, 6, 8, 3e-5);
  Random random(6);
  const SceneTable& table = trial.library.table;
  for (const ReadingKind kind : {ReadingKind::absolute, ReadingKind::change})
    for (const std::size_t truth : {std::size_t{0}, std::size_t{5}, std::size_t{40}}) {
      trial.measure(kind, table.outcome[truth] == 0 ? truth : 3, 3e-5, random);
      trial.forget_sigmas();
      CHECK(largest_difference(trial, {.noise = {NoiseShape::gaussian, std::nullopt}}) < 1e-3);
    }
}

TEST_CASE("Numbers of missing blocks without any weight beforehand have no probability, others all of it") {
  Trial trial(4, 6, 8, 3e-5);
  Random random(7);
  for (const std::size_t truth : {std::size_t{0}, std::size_t{5}, trial.library.table.rows / 2}) {
    trial.measure(ReadingKind::change, trial.library.table.outcome[truth] == 0 ? truth : 3, 3e-5, random);
    for (const std::vector<double>& weight :
         {std::vector{0.0, 1.0, 1.0}, std::vector{1.0, 0.0, 1.0}, std::vector{1.0, 1.0, 0.0}})
      CHECK(largest_difference(trial, {.prior = {{0, 1, 2}, weight}}) < 1e-3);
  }
}

TEST_CASE("Where sensors are never silent without a reason, scenes that do not explain it are impossible") {
  Trial trial(4, 6, 8, 3e-5);
  Random random(8);
  trial.measure(ReadingKind::change, 0, 3e-5, random);
  NoiseModel never{NoiseShape::gaussian, 0.0};
  never.silence = 0.0;
  for (std::size_t silent = 0; silent < 3; ++silent) {
    trial.comparison.measured.displacement[5 * silent] = kUnknown;
    trial.comparison.measured.silent[5 * silent] = true;
    CHECK(largest_difference(trial, {.noise = never}) < 1e-3);
  }
}

TEST_CASE("Scenes that make the same collapse of metres share its probability") {
  Trial trial(2, 30, 8, 3e-5);
  Random random(8);
  SyntheticLibrary& library = trial.library;
  for (std::size_t i = 0; i < trial.sensitivities.scenes.size(); ++i)
    trial.sensitivities.epoch.own(i) *= 100.0;
  trial.comparison.factors = factors_of(library, trial.sensitivities);
  std::vector<std::size_t> collapses;
  for (std::size_t row = 0; row < library.table.rows; ++row) {
    if (library.outcome[row] == 0) continue;
    collapses.push_back(row);
    for (std::size_t i = 0; i < library.points.size(); ++i)
      library.vertical[row * library.points.size() + i] +=
          -0.5 - 0.1 * static_cast<double>(i % 5) + 1e-4 * random.gaussian();
  }
  library.make_index();
  for (const ReadingKind kind : {ReadingKind::absolute, ReadingKind::change})
    for (std::size_t i = 0; i < collapses.size(); i += 20) {
      trial.measure(kind, collapses[i], 2e-5, random);
      CHECK(largest_difference(trial, {}) < 1e-3);
    }
}

/// Of the posterior, and of all its scenes if this is supposed of the readings.
struct TwoEvidences {
  double of_posterior, of_wider;
};

TwoEvidences evidences(const Trial& trial, const Supposition& supposed, const Prior& stated) {
  const SceneTable& table = trial.library.table;
  const Asked asked{.prior = stated_prior(stated, table, false)};
  const Eligible eligible = eligible_rows(table, asked.prior.missing);
  const Observation observation = observe(trial.comparison, asked.noise, asked.nuisance);
  const UnknownBridgeQuestion question(trial.comparison, observation, asked.settings);
  const RowValues logs{kImpossible, all_rows(table), brute_force(trial, observation, asked, eligible)};
  const std::vector<double> parts = question.log_parts_of(eligible.rows, eligible, asked.prior, supposed);
  return {posterior(table, eligible, logs, asked.prior, trial.library.blocks).log_evidence,
          std::accumulate(parts.begin(), parts.end(), kImpossible, log_sum)};
}

TEST_CASE("Larger errors count as if they had been stated, whatever the scale of the weights beforehand") {
  Trial trial(3, 5, 8, 3e-5);
  Random random(9);
  for (const std::vector<double>& weight : {std::vector<double>{}, {8.0, 1.0, 1.0}, {800.0, 100.0, 100.0}}) {
    trial.measure(ReadingKind::change, 3, 2e-5, random);
    const Prior prior = weight.empty() ? Prior{} : Prior{{0, 1, 2}, weight};
    const TwoEvidences as_stated = evidences(trial, {}, prior);
    CHECK(as_stated.of_wider == Approx(as_stated.of_posterior).margin(1e-6));
    const double wider = evidences(trial, {.errors = 3.0}, prior).of_wider;
    for (double& sigma : trial.comparison.measured.sigma) sigma *= 3.0;
    CHECK(wider == Approx(evidences(trial, {}, prior).of_posterior).margin(1e-6));
  }
}

TEST_CASE("A gross error of one reading counts as if it had been stated for that reading") {
  Trial trial(3, 5, 8, 3e-5);
  Random random(19);
  for (const std::size_t channel : {std::size_t{0}, std::size_t{4}}) {
    trial.measure(ReadingKind::change, 3, 2e-5, random);
    const double gross = evidences(trial, {.gross = {{channel, 7e-4}}}, {}).of_wider;
    trial.comparison.measured.sigma[channel] += 7e-4;
    CHECK(gross == Approx(evidences(trial, {}, {}).of_posterior).margin(1e-6));
  }
}

TEST_CASE("Whatever a bridge is asked that is not known, the screen hardly changes a probability",
          "[many-solutions]") {
  check_random_questions(2, 150);
}

TEST_CASE("Nor does it where up to three blocks are missing", "[many-solutions]") {
  check_random_questions(4, 60, 3);
}

TEST_CASE("The same of thousands of questions", "[.long]") {
  check_random_questions(3, 6000);
  check_random_questions(5, 1000, 3);
}
