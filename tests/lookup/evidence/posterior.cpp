/// @file The posterior, against brute force in extended precision.

#include "lookup/evidence/posterior.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "lookup/evidence/evidence.h"
#include "tests/lookup/evidence/textbook_likelihood.h"

using namespace voussoir;
using namespace voussoir::test;

namespace {

/// Number by number: prior, scenes of the library that have it.
struct Numbers {
  std::vector<double> weight;
  std::vector<long double> scenes;
};

void check_against_brute_force(const SyntheticLibrary& library, const Numbers& numbers) {
  Prior prior = stated_prior({}, library.table, true);
  prior.weight = numbers.weight;
  const Eligible eligible = eligible_rows(library.table, prior.missing);
  REQUIRE(eligible.rows.size() == library.table.rows);
  for (const NoiseShape shape : kShapes) {
    const NoiseModel noise{shape, 0.06};
    const Measurements measured = readings_of(library, 7, 0.05, 7);
    const auto logs = log_evidence_of_rows(library.observe(measured, noise), library.table, eligible.rows);
    const Posterior result = posterior(library.table, eligible, logs, prior, library.blocks);
    std::vector<long double> weight(library.table.rows);
    long double total = 0.0L;
    for (std::size_t row = 0; row < library.table.rows; ++row) {
      const auto missing = static_cast<std::size_t>(missing_blocks(library.table, row));
      weight[row] = numbers.weight[missing] / numbers.scenes[missing] *
                    likelihood(measured, library.table.row(row), library.intact(), noise, shape, 0.06L);
      total += weight[row];
    }
    const long double beforehand = std::accumulate(numbers.weight.begin(), numbers.weight.end(), 0.0L);
    CHECK(result.log_evidence == Approx(static_cast<double>(std::log(total / beforehand))).epsilon(1e-9));
    std::vector<long double> block(library.blocks, 0.0L), missing(numbers.scenes.size(), 0.0L);
    for (std::size_t row = 0; row < library.table.rows; ++row) {
      const long double p = weight[row] / total;
      REQUIRE(result.probability[row] == Approx(static_cast<double>(p)).margin(1e-12));
      missing[static_cast<std::size_t>(missing_blocks(library.table, row))] += p;
      for (const BlockId id : library.table.scene(row).removed) block[static_cast<std::size_t>(id)] += p;
    }
    for (std::size_t id = 0; id < library.blocks; ++id)
      REQUIRE(result.block_probability[id] == Approx(static_cast<double>(block[id])).margin(1e-12));
    for (std::size_t i = 0; i < missing.size(); ++i)
      REQUIRE(result.missing_probability[i] == Approx(static_cast<double>(missing[i])).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("The posterior is prior times likelihood, normalised by brute force in extended precision") {
  check_against_brute_force(SyntheticLibrary(3, 5), {{1.0, 2.0, 1.0}, {1.0L, 15.0L, 105.0L}});
}

TEST_CASE("So it is of up to three missing blocks") {
  check_against_brute_force(SyntheticLibrary(3, 5, 3), {{1.0, 2.0, 1.0, 3.0}, {1.0L, 15.0L, 105.0L, 455.0L}});
}

TEST_CASE("A scene that falls as the file says counts by the share of bridges that stand (closed form)") {
  SyntheticLibrary library(2, 3, 1);
  constexpr std::size_t kFall = 2;
  std::ranges::fill(library.outcome, static_cast<std::uint8_t>(Outcome::standing));
  library.outcome[kFall] = static_cast<std::uint8_t>(Outcome::collapsed);
  std::vector<double> share(library.table.rows, 0.0);
  share[kFall] = 0.25;
  SceneTable table = library.table;
  table.standing_share = share;
  const Prior prior = {{0, 1}, {3.0, 1.0}};
  const Eligible eligible = eligible_rows(table, prior.missing);
  CHECK(eligible.scenes == std::vector{1.0, 5.25});
  CHECK(eligible.standing == std::vector{1.0, 5.25});
  const RowValues nothing_said{kImpossible, eligible.rows, std::vector<double>(eligible.rows.size(), 0.0)};
  const Posterior result = posterior(table, eligible, nothing_said, prior, library.blocks);
  CHECK(result.missing_probability[1] == Approx(0.25));
  CHECK(result.probability[kFall] == Approx(0.25 * 0.25 / 5.25));
  CHECK(result.probability[kFall + 1] == Approx(0.25 / 5.25));
  CHECK(result.intact_if_even == Approx(0.5));
  REQUIRE(result.open_losses.size() == 6);
  for (const OpenLoss& open : result.open_losses) CHECK(open.times_as_likely == Approx(1.0));
}

TEST_CASE("A prior that is not given is of the numbers that the table holds, each as what is believed says") {
  const SyntheticLibrary pairs(3, 5), triples(3, 5, 3);
  CHECK(stated_prior({}, pairs.table, true).missing == std::vector<int>{0, 1, 2});
  CHECK(weights_of(stated_prior({}, triples.table, true)) == std::vector<double>{8.0, 1.0, 1.0, 1.0});
  CHECK(stated_prior({}, triples.table, false).weight == std::vector<double>{1000.0, 10.0, 1.0, 0.1});
  CHECK(stated_prior({{3, 1}, {}}, triples.table, false).weight == std::vector<double>{0.1, 10.0});
  SceneTable some = triples.table;  // the last singles and the first pairs
  some.removed = some.removed.subspan(10 * some.most_missing);
  some.rows = 20;
  CHECK(stated_prior({}, some, true).missing == std::vector<int>{1, 2});
}

TEST_CASE("The credible set is the shortest list of likeliest rows that holds 95 % of the probability") {
  const SyntheticLibrary library(3, 5);
  const Eligible eligible = eligible_rows(library.table, {1});
  const Measurements measured = readings_of(library, 7, 0.2, 8);
  const auto logs = log_evidence_of_rows(library.observe(measured, {NoiseShape::gaussian, 0.3}),
                                         library.table, eligible.rows);
  const Posterior result = posterior(library.table, eligible, logs, {{1}, {}}, library.blocks);
  REQUIRE(result.credible.size() > 2);
  double share = 0.0;
  for (std::size_t i = 0; i < result.credible.size(); ++i) {
    CHECK(share < kCredibleShare);
    share += result.probability[result.credible[i]];
    if (i > 0) CHECK(result.probability[result.credible[i]] <= result.probability[result.credible[i - 1]]);
  }
  CHECK(share >= kCredibleShare);
}

TEST_CASE(
    "Unresolved rows take no part and are counted, and so do rows with other numbers of missing blocks") {
  SyntheticLibrary library(3, 5);
  library.outcome[4] = static_cast<std::uint8_t>(Outcome::unresolved);
  const Eligible eligible = eligible_rows(library.table, {1});
  CHECK(eligible.unresolved == 1);
  CHECK(eligible.rows.size() == 14);
  const Measurements measured = readings_of(library, 4, 0.0, 9);
  const auto logs = log_evidence_of_rows(library.observe(measured, {NoiseShape::gaussian, 0.1}),
                                         library.table, eligible.rows);
  const Posterior result = posterior(library.table, eligible, logs, {{1}, {}}, library.blocks);
  CHECK(result.probability[4] == 0.0);
  CHECK(result.probability[0] == 0.0);
  const std::vector<double>& values = result.probability.values;
  CHECK(std::accumulate(values.begin(), values.end(), 0.0) == Approx(1.0));
}

TEST_CASE("Scenes that fall and keep no field are nobody's readings, and no prior is theirs (counted)") {
  SyntheticLibrary library(3, 5);  // without the second block it falls, and fields are there
  const std::size_t single = 2;
  const std::size_t pair = library.row_of(Scene{{BlockId{1}, BlockId{7}}});
  for (const std::size_t row : {single, pair}) {
    REQUIRE(library.outcome[row] == static_cast<std::uint8_t>(Outcome::collapsed));
    std::fill_n(library.vertical.begin() + static_cast<std::ptrdiff_t>(row * library.table.points),
                library.table.points, std::numeric_limits<double>::quiet_NaN());
  }
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  CHECK(eligible.fallen == std::vector<std::size_t>{0, 1, 1});
  CHECK(eligible.scenes == std::vector<double>{1, 14, 104});
  CHECK(eligible.standing == std::vector<double>{1, 14, 91});  // of 14 blocks: 14, 14 * 13 / 2
  const Prior prior{{0, 1, 2}, {8.0, 1.0, 1.0}};
  CHECK(std::exp(log_prior_by_missing(library.table, eligible, prior)[1]) == Approx(0.1 / 14.0));
}

TEST_CASE("Readings that say nothing leave even odds even, and no loss is ruled out (closed form)") {
  const SyntheticLibrary library(3, 5);
  const Eligible eligible = eligible_rows(library.table, {0, 1});
  RowValues logs{kImpossible, eligible.rows, std::vector<double>(eligible.rows.size(), 0.0)};
  logs.values[2] = kImpossible;  // what falls shows
  logs.values[8] = std::log(0.09);
  logs.values[9] = std::log(0.11);
  const Posterior result = posterior(library.table, eligible, logs, {{0, 1}, {1000.0, 10.0}}, library.blocks);
  const double damaged = (12.0 + 0.09 + 0.11) / 14.0;  // of the losses that leave the bridge standing
  CHECK(result.intact_if_even == Approx(1.0 / (1.0 + damaged)));
  REQUIRE(result.open_losses.size() == 13);  // all that stand but the one below a tenth
  for (const OpenLoss& loss : result.open_losses) {
    CHECK(loss.row != 2);
    CHECK(loss.row != 8);
    CHECK(loss.times_as_likely == Approx(loss.row == 9 ? 0.11 : 1.0));
  }
}

TEST_CASE("If every scene is impossible there is no probability at all") {
  const SyntheticLibrary library(2, 3);
  const Eligible eligible = eligible_rows(library.table, {0, 1, 2});
  Measurements measured = readings_of(library, 2, 0.0, 10);
  measured.displacement[3] *= 50.0;
  const auto logs = log_evidence_of_rows(library.observe(measured, {NoiseShape::uniform, 0.05}),
                                         library.table, eligible.rows);
  const Posterior result =
      posterior(library.table, eligible, logs, stated_prior({}, library.table, true), library.blocks);
  CHECK(result.credible.empty());
  for (const std::size_t row : eligible.rows) CHECK(result.probability[row] == 0.0);
}

TEST_CASE("A prior needs a weight for each number of missing blocks") {
  const SyntheticLibrary library(2, 3);
  const Eligible eligible = eligible_rows(library.table, {0, 1});
  CHECK_THROWS_AS(posterior(library.table, eligible, {0.0, {}, {}}, {{0, 1}, {1.0}}, 6), InputError);
  for (const Prior& nothing_possible : {Prior{{0, 1}, {0.0, 0.0}}, Prior{{0, 2}, {0.0, 1.0}}})
    CHECK_THROWS_WITH(log_prior_by_missing(library.table, eligible, nothing_possible),
                      Catch::Contains("leave no scene of the database possible, expected a positive weight"));
  CHECK(log_prior_by_missing(library.table, eligible, {{0, 1}, {0.0, 1.0}})[1] ==
        Approx(std::log(1.0 / 6.0)));
}

TEST_CASE(
    "A silent sensor counts with its chance of failing where its block stands, and costs nothing where it is "
    "gone") {
  const SyntheticLibrary library(2, 4);
  Measurements measured = readings_of(library, 0, 0.02, 11);
  const auto rows = all_rows(library.table);
  const NoiseModel noise{NoiseShape::gaussian, 0.05};
  for (const std::size_t point : {std::size_t{2}, std::size_t{3}})  // both sensors of the second top block
    measured.displacement[point] = std::nan("");
  const auto unlisted = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
  for (const std::size_t point : {std::size_t{2}, std::size_t{3}}) measured.silent[point] = true;
  const auto silent = log_evidence_of_rows(library.observe(measured, noise), library.table, rows);
  const BlockId block = library.points[2].block;
  int standing = 0, gone = 0;
  for (const std::size_t row : rows) {
    const bool lacks = library.table.scene(row).lacks(block);
    REQUIRE((silent[row] == -kInfinity) == (unlisted[row] == -kInfinity));
    if (unlisted[row] == -kInfinity) continue;
    ++(lacks ? gone : standing);
    CHECK(silent[row] - unlisted[row] == Approx(lacks ? 0.0 : 2.0 * std::log(noise.silence)).margin(1e-9));
  }
  CHECK(standing > 3);
  CHECK(gone > 3);
}
