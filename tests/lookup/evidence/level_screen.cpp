/// @file Scenes worked out in the order of estimates, against all of them worked out, over random questions.

#include "lookup/evidence/level_screen.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "lookup/evidence/evidence.h"
#include "lookup/evidence/evidence_screen.h"
#include "lookup/evidence/level_evidence.h"
#include "lookup/evidence/level_likelihood.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/evidence/table_evidence.h"
#include "lookup/search/exhaustive_search.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::SyntheticLibrary;

namespace {

/// Noise, outliers, stiffness and what is told of them, all at random.
Observation random_question(const SyntheticLibrary& library, Random& random) {
  constexpr std::array kShapes = {NoiseShape::automatic, NoiseShape::uniform, NoiseShape::gaussian,
                                  NoiseShape::laplace, NoiseShape::student};
  const auto chance = [&](double share) { return random.uniform() < share; };
  const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
  const double level = std::pow(10.0, -4.0 + 3.5 * random.uniform());
  Measurements measured = library.measure(truth, level, kShapes[1 + random.below(3)], random);
  Nuisance nuisance;
  if (chance(0.5)) nuisance.scale = 0.1 * random.uniform();
  NoiseModel noise{kShapes[random.below(5)], std::nullopt};
  // The factor is fitted by squares, which wild readings spoil, and Student's t is estimated from one level.
  const bool wild = nuisance.scale == 0.0 && noise.shape != NoiseShape::student && chance(0.3);
  const double stiffer = nuisance.scale > 0.0 ? 1.0 + nuisance.scale * random.gaussian() : 1.0;
  for (double& value : measured.displacement) {
    value *= stiffer * (wild && chance(0.1) ? 1.0 + random.gaussian() : 1.0);
    if (chance(0.2)) value = std::nan("");
  }
  if (chance(0.5)) noise.floor = 1e-3 * std::pow(10.0, -4.0 * random.uniform());
  ModelError error;
  if (chance(0.7)) error = {0.05 * random.uniform(), 0.05 * random.uniform(), {}};
  if (noise.shape == NoiseShape::gaussian && chance(0.5)) nuisance.datum = 1e-4, nuisance.tilt = 1e-5;
  return library.observe(measured, noise, nuisance, error);
}

/// What evidence_that_matters works out, of all rows.
std::vector<double> all_worked_out(const Observation& observation, const SceneTable& table,
                                   std::span<const std::size_t> rows, std::span<const std::size_t> likely) {
  std::vector<std::vector<double>> logs;
  for (const auto& shapes : groups_of(observation.noise)) {
    auto values = observation.unknown_level
                      ? evidence_over_levels(observation, shapes,
                                             likeliest_level(observation, shapes, table, likely), table, rows)
                      : log_likelihoods_at(observation, shapes, stated_level(observation), table, rows);
    for (std::vector<double>& of_shape : values) logs.push_back(std::move(of_shape));
  }
  return log_mean(std::move(logs));
}

/// By what share of the probability evidence of some rows is off that of all; nothing if none is possible.
std::optional<double> share_off(const std::vector<double>& all, const std::vector<double>& some,
                                const std::vector<double>& beforehand) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < all.size(); ++i) most = std::max(most, all[i] + beforehand[i]);
  if (!(most > -std::numeric_limits<double>::infinity())) return std::nullopt;
  double off = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double probability = std::exp(all[i] + beforehand[i] - most);
    sum += probability;
    off += std::abs(probability - std::exp(some[i] + beforehand[i] - most));
  }
  return off / sum;
}

/// log of the mean over all levels and shapes by Gauss's rule in many small panels.
std::vector<double> brute_force(const Observation& observation, const SceneTable& table,
                                std::span<const std::size_t> rows) {
  using Rule = boost::math::quadrature::gauss<double, 7>;
  constexpr int kPanels = 200;
  const double first = std::log(kSmallestLevel), width = std::log(kLargestLevel / kSmallestLevel) / kPanels;
  std::vector<double> result(table.rows, -std::numeric_limits<double>::infinity());
  for (const NoiseShape shape : shapes_of(observation.noise))
    for (int panel = 0; panel < kPanels; ++panel)
      for (std::size_t node = 0; node < 7; ++node) {
        const std::size_t k = node < 3 ? 3 - node : node - 3;
        const double place = 0.5 + (node < 3 ? -0.5 : 0.5) * Rule::abscissa()[k];
        const auto logs = log_likelihoods_at(observation, std::array{shape},
                                             std::exp(first + width * (panel + place)), table, rows);
        const double log_weight = std::log(0.5 * Rule::weights()[k] / kPanels);
        for (std::size_t i = 0; i < rows.size(); ++i)
          result[rows[i]] = log_sum(result[rows[i]], logs.front()[i] + log_weight);
      }
  const std::vector<double> log_silence = log_chance_of_silence(observation, table, rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    result[rows[i]] += log_silence[i] - std::log(static_cast<double>(shapes_of(observation.noise).size()));
  return result;
}

/// Of all rows' probabilities, added up.
double difference(const Posterior& one, const Posterior& other, std::size_t rows) {
  double sum = 0.0;
  for (std::size_t row = 0; row < rows; ++row) sum += std::abs(one.probability[row] - other.probability[row]);
  return sum;
}

}  // namespace

TEST_CASE("Whatever is asked of an unknown level, brute force over levels and scenes gives the same answer",
          "[many-solutions]") {
  const SyntheticLibrary library(3, 7);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  const Prior prior = stated_prior({}, library.table, true);
  const EvidenceScreen screen(library.table, library.index.view(), eligible, prior);
  Random random(7);
  constexpr std::size_t kTop = 5;
  std::size_t worked_out = 0, asked = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const Observation observation = random_question(library, random);
    const auto shapes = shapes_of(observation.noise);
    // Brute force cuts edges, and bounded errors beside an open factor are gone through level by level only
    // as far as one rise and one fall of the likelihood reach.
    const bool has_edges = shapes.front() == NoiseShape::uniform &&
                           (!observation.has_model_error() || observation.unknown_scale > 0.0);
    if (observation.count == 0 || has_edges) continue;
    asked += eligible.rows.size();
    INFO("trial " << trial << " " << to_string(observation.noise.shape) << " floor "
                  << observation.noise.floor << " error " << observation.error_share << " scale "
                  << observation.unknown_scale);
    const RowValues some = screen(observation, kTop);
    const RowValues all{kImpossible, test::all_rows(library.table),
                        brute_force(observation, library.table, eligible.rows)};
    const Posterior exact = posterior(library.table, eligible, all, prior, library.blocks);
    const Posterior screened = posterior(library.table, eligible, some, prior, library.blocks);
    worked_out += static_cast<std::size_t>(
        std::ranges::count_if(some.values, [](double v) { return std::isfinite(v); }));
    // What is left out, and the rules of integration; a percent of a probability at the uniform shape's edge.
    CHECK(difference(screened, exact, library.table.rows) <
          (shapes.front() == NoiseShape::uniform ? 1e-2 : 1e-3));
    std::vector<std::size_t> order(library.table.rows);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](std::size_t row) { return exact.probability[row]; });
    for (std::size_t i = 0; i < kTop && exact.probability[order[i]] > 1e-4; ++i)
      CHECK(std::isfinite(some[order[i]]));
  }
  CHECK(worked_out < asked / 2);  // the screen does screen
}

TEST_CASE("Scenes in the order of estimates, until the rest holds a millionth, give all scenes' answer",
          "[many-solutions]") {
  const SyntheticLibrary library(3, 9);
  const auto rows = eligible_rows(library.table, {0, 1, 2}).rows;
  Random random(8);
  int questions = 0, off_by_more = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Observation observation = random_question(library, random);
    if (trial % 4 == 0) {
      observation.noise.relative = 0.3 * random.uniform();
      observation.unknown_level = false;
    }
    if (has_closed_form(observation) || observation.count == 0) continue;
    std::vector<double> beforehand(rows.size());
    for (double& one : beforehand) one = random.gaussian();
    std::vector<std::size_t> likely;
    for (const ScoredRow& found : exhaustive_search(observation.displacement, library.table, rows, 16))
      likely.push_back(found.row);
    std::sort(likely.begin(), likely.end());
    INFO("trial " << trial << " " << to_string(observation.noise.shape) << " floor "
                  << observation.noise.floor << " error " << observation.error_share << " scale "
                  << observation.unknown_scale);
    const auto some =
        evidence_that_matters(observation, library.table, rows, beforehand, likely, 1, kScreenedAway);
    const std::vector<double> all = all_worked_out(observation, library.table, rows, likely);
    const std::optional<double> off = share_off(all, some, beforehand);
    if (!off) continue;
    ++questions;
    off_by_more += *off > 2.0 * kScreenedAway;  // what is left out, and what is worked out less precisely
    // Estimates over levels are no bounds: a scene may have a second peak at a level where nobody looked.
    CHECK(*off < (observation.unknown_level ? 100.0 : 2.0) * kScreenedAway);
  }
  CHECK(questions > 400);
  CHECK(off_by_more * 50 < questions);
}
