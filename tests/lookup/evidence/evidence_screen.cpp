/// @file The screened posterior against the one that works out every row.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "lookup/evidence/evidence.h"
#include "lookup/evidence/evidence_screen.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::SyntheticLibrary;

namespace {

struct Question {
  NoiseModel noise;
  Nuisance nuisance{};
  ModelError error{};
};

void check_same(const SyntheticLibrary& library, const EvidenceScreen& screen, const Eligible& eligible,
                const Prior& prior, const Measurements& measured, const Question& question) {
  const Observation observation =
      library.observe(measured, question.noise, question.nuisance, question.error);
  INFO(to_string(question.noise.shape)
       << " level " << question.noise.relative.value_or(-1.0) << " floor " << question.noise.floor
       << " scale " << question.nuisance.scale << " model error " << question.error.share);
  const Posterior exact =
      posterior(library.table, eligible, log_evidence_of_rows(observation, library.table, eligible.rows),
                prior, library.blocks);
  const Posterior screened = posterior(library.table, eligible, screen(observation), prior, library.blocks);
  for (std::size_t row = 0; row < library.table.rows; ++row)
    REQUIRE(screened.probability[row] == Approx(exact.probability[row]).margin(2.0 * kScreenedAway));
  for (std::size_t id = 0; id < library.blocks; ++id)
    REQUIRE(screened.block_probability[id] ==
            Approx(exact.block_probability[id]).margin(2.0 * kScreenedAway));
  REQUIRE(screened.credible == exact.credible);
}

}  // namespace

TEST_CASE("The screened posterior is the exact one, for stated and unknown noise of every shape and size") {
  const SyntheticLibrary library(4, 9);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  const Prior prior = stated_prior({}, library.table, true);
  const EvidenceScreen screen(library.table, library.index.view(), eligible, prior);
  Random random(1);
  std::size_t kept = 0, trials = 0;
  for (const double level : {0.0, 1e-5, 0.003, 0.02, 0.1, 0.3})
    for (const NoiseShape shape : {NoiseShape::automatic, NoiseShape::uniform, NoiseShape::gaussian,
                                   NoiseShape::laplace, NoiseShape::student})
      for (const bool stated : {true, false}) {
        const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
        Measurements measured = library.measure(truth, level, NoiseShape::uniform, random);
        for (double& value : measured.displacement)
          if (random.below(5) == 0) value = std::nan("");
        NoiseModel noise{shape, stated ? std::optional(std::max(level, 1e-3)) : std::nullopt};
        check_same(library, screen, eligible, prior, measured, {noise});
        noise.floor = 1e-5;
        check_same(library, screen, eligible, prior, measured, {noise});
        check_same(library, screen, eligible, prior, measured, {noise, {}, {0.03, 0.02, {}}});
        check_same(library, screen, eligible, prior, measured, {noise, {}, {0.08, 0.15, {}}});
        check_same(library, screen, eligible, prior, measured, {noise, {0.01}});
        if (shape == NoiseShape::gaussian)
          check_same(library, screen, eligible, prior, measured, {noise, {0.1, 1e-4, 1e-5}});
        if (level > 0.02 || shape == NoiseShape::student) continue;  // much noise leaves many scenes possible
        noise.floor = 0.0;
        const std::vector<double> logs = screen(library.observe(measured, noise)).values;
        kept +=
            static_cast<std::size_t>(std::ranges::count_if(logs, [](double v) { return std::isfinite(v); }));
        ++trials;
      }
  CHECK(kept < trials * library.table.rows / 2);  // the screen does screen
}

TEST_CASE("The screened posterior has no row when every scene is impossible") {
  const SyntheticLibrary library(2, 5);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  const Prior prior = stated_prior({}, library.table, true);
  const EvidenceScreen screen(library.table, library.index.view(), eligible, prior);
  Random random(2);
  Measurements measured = library.measure(0, 0.0, NoiseShape::uniform, random);
  measured.displacement[3] *= 50.0;
  const RowValues evidence = screen(library.observe(measured, {NoiseShape::uniform, 0.05}));
  CHECK(posterior(library.table, eligible, evidence, prior, library.blocks).credible.empty());
}

TEST_CASE("Sensors' own sigmas are screened as well, and a library without an index") {
  const SyntheticLibrary library(2, 5);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  Random random(3);
  Measurements measured = library.measure(3, 0.02, NoiseShape::uniform, random);
  for (const SearchIndex& index : {library.index.view(), SearchIndex{}}) {
    const Prior prior = stated_prior({}, library.table, true);
    const EvidenceScreen screen(library.table, index, eligible, prior);
    measured.sigma.assign(measured.sigma.size(), std::nan(""));
    measured.sigma[1] = 1e-4;
    check_same(library, screen, eligible, prior, measured, {{NoiseShape::gaussian, 0.02}});
    check_same(library, screen, eligible, prior, measured, {{}});
    measured.sigma.assign(measured.sigma.size(), 3e-5);
    check_same(library, screen, eligible, prior, measured, {{}, {}, {0.1, 0.05, {}}});
  }
}

TEST_CASE("What is kept from one question about the same sensors to the next changes no answer") {
  const SyntheticLibrary library(4, 9);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  const Prior prior = stated_prior({}, library.table, true);
  const EvidenceScreen screen(library.table, library.index.view(), eligible, prior);
  const NoiseModel noise{NoiseShape::gaussian, 0.02};
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    Measurements measured = library.measure(truth, 0.02, NoiseShape::gaussian, random);
    measured.sigma.assign(measured.sigma.size(), std::nan(""));
    ModelError error{0.03, 0.02, {}};
    // One thing at a time is another for a question or two, and then as before.
    if (trial % 12 == 3 || trial % 12 == 4)
      for (std::size_t i = 0; i < measured.displacement.size(); i += 3)
        measured.displacement[i] = std::nan("");
    if (trial % 12 == 6) {
      measured.sigma[5] = 1e-3;
      measured.displacement[5] += 1e-3;
    }
    if (trial % 12 == 8) error.common = 0.3;
    if (trial % 12 == 10 || trial % 12 == 11) error.share = 0.2;
    check_same(library, screen, eligible, prior, measured, {noise, {}, error});
  }
}

TEST_CASE("What one shape leaves out because another explains the readings changes no probability") {
  const SyntheticLibrary library(3, 7);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  Random random(4);
  for (const NoiseShape truth : {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace})
    for (const double level : {0.003, 0.02, 0.1}) {
      const std::size_t row = random.below(static_cast<std::uint32_t>(library.table.rows));
      const Measurements measured = library.measure(row, level, truth, random);
      std::vector<double> sum(library.table.rows, 0.0);
      const auto evidence_of = [&](NoiseShape shape) {
        const Observation observation = library.observe(measured, {shape}, {0.01});
        return log_evidence_of_each(observation, library.table, eligible.rows);
      };
      const std::vector<double> together = evidence_of(NoiseShape::automatic);
      const double best = *std::max_element(together.begin(), together.end());
      for (const NoiseShape shape : {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace}) {
        const std::vector<double> logs = evidence_of(shape);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += std::exp(logs[i] - best) / 3.0;
      }
      double off = 0.0;  // relative to the likeliest scene, all scenes together
      for (std::size_t i = 0; i < sum.size(); ++i) off += std::abs(sum[i] - std::exp(together[i] - best));
      INFO(to_string(truth) << " " << level);
      CHECK(off < kScreenedAway);
    }
}
