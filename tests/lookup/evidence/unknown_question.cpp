/// @file Questions about a bridge that is not exactly known. Oracle: the evidence of every scene, worked out
/// one by one.

#include "lookup/evidence/unknown_question.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/scene_evidence.h"
#include "tests/lookup/evidence/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;

namespace {

struct Trial {
  SyntheticLibrary library{4, 6};
  Sensitivities sensitivities = made_up_sensitivities_of(library, 8, 3e-5);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  void measure(ReadingKind kind, std::size_t truth, double sigma, Random& random) {
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.02, {}};
    std::vector<double> theta(8);
    for (double& one : theta) one = random.gaussian();
    const SceneFactors factors = comparison.factors->of(library.table.scene(truth));
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      double shown = library.table.row(truth)[i] + sigma * random.gaussian();
      for (std::size_t k = 0; k < theta.size(); ++k)
        shown +=
            theta[k] * (factors.bridge(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) -
                        (is_change(kind) ? comparison.factors->intact.bridge(static_cast<Eigen::Index>(i),
                                                                             static_cast<Eigen::Index>(k))
                                         : 0.0));
      comparison.measured.displacement[i] = shown;
      comparison.measured.sigma[i] = sigma;
      comparison.measured.silent[i] = std::isnan(shown);
    }
  }
};

}  // namespace

TEST_CASE("What the screen leaves out or estimates changes no probability by more than a thousandth") {
  Trial trial;
  Random random(5);
  const SceneTable& table = trial.library.table;
  const Eligible eligible = eligible_rows(table, {0, 1, 2});
  const Prior prior = stated_prior({}, false);
  double worst = 0.0;
  for (const ReadingKind kind : {ReadingKind::absolute, ReadingKind::change})
    for (const double sigma : {3e-6, 3e-5, 3e-4})
      for (int repeat = 0; repeat < 4; ++repeat) {
        const std::size_t truth =
            repeat == 0 ? 0 : std::size_t{random.below(static_cast<std::uint32_t>(table.rows))};
        trial.measure(kind, table.outcome[truth] == 0 ? truth : 0, sigma, random);
        const Observation observation = observe(trial.comparison, {NoiseShape::gaussian, 0.0}, {});
        UnknownBridgeQuestion question(trial.comparison, observation, {.conditions = Conditions::known});
        const auto screened = question.log_evidence(eligible, prior, 10);
        const auto logs = scatter_logs(question.bridge(), observation, table, eligible.rows, 2);
        const auto silence = log_chance_of_silence(observation, table, eligible.rows);
        std::vector<double> exact(table.rows, -std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < eligible.rows.size(); ++i)
          exact[eligible.rows[i]] = over_scatter(logs[i]) + silence[i];
        const Posterior found = posterior(table, eligible, screened, prior, trial.library.blocks);
        const Posterior wanted = posterior(table, eligible, exact, prior, trial.library.blocks);
        for (std::size_t block = 0; block < trial.library.blocks; ++block)
          worst = std::max(worst, std::abs(found.block_probability[block] - wanted.block_probability[block]));
        worst =
            std::max(worst, std::abs(found.missing_probability.front() - wanted.missing_probability.front()));
      }
  INFO(worst);
  CHECK(worst < 1e-3);
}

TEST_CASE("Cases that are not looked at change no probability by more than a thousandth") {
  Trial trial;
  Random random(6);
  const SceneTable& table = trial.library.table;
  const Eligible eligible = eligible_rows(table, {0, 1, 2});
  const Prior prior = stated_prior({}, false);
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double worst = 0.0;
  for (const ReadingKind kind : {ReadingKind::absolute, ReadingKind::change})
    for (const std::size_t truth : {std::size_t{0}, std::size_t{5}, std::size_t{40}}) {
      trial.measure(kind, table.outcome[truth] == 0 ? truth : 3, 3e-5, random);
      trial.comparison.measured.sigma.assign(trial.library.points.size(), kUnknown);
      const Observation observation = observe(trial.comparison, {NoiseShape::gaussian, std::nullopt}, {});
      UnknownBridgeQuestion question(trial.comparison, observation, {});
      const auto screened = question.log_evidence(eligible, prior, 10);
      UnknownBridge bridge = question.bridge();
      std::vector<CaseTerms> cases;
      for (double level = 1e-3; level <= kLargestLevel; level *= 2.0)
        for (const double conditions : kConditionSizes) {
          set_case(observation, {level, conditions}, bridge);
          cases.push_back(case_terms(bridge));
        }
      const auto logs = scatter_logs(bridge, cases, observation, table, eligible.rows, {}, 2);
      const auto silence = log_chance_of_silence(observation, table, eligible.rows);
      std::vector<double> exact(table.rows, -std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < eligible.rows.size(); ++i) {
        double& sum = exact[eligible.rows[i]];
        for (std::size_t k = 0; k < cases.size(); ++k)
          sum = log_sum(sum, over_scatter(logs[i * cases.size() + k]));
        sum += silence[i] - std::log(static_cast<double>(cases.size()));
      }
      const Posterior found = posterior(table, eligible, screened, prior, trial.library.blocks);
      const Posterior wanted = posterior(table, eligible, exact, prior, trial.library.blocks);
      for (std::size_t row = 0; row < table.rows; ++row)
        worst = std::max(worst, std::abs(found.probability[row] - wanted.probability[row]));
    }
  INFO(worst);
  CHECK(worst < 1e-3);
}
