/// @file Sentences of answers. Oracle: the sentences, written out.

#include "lookup/report/report_words.h"

#include <catch2/catch.hpp>
#include <cmath>
#include "tests/lookup/explained_answer.h"
#include "tests/lookup/synthetic_library.h"

#include "lookup/report/bridge_report.h"
#include "lookup/report/words.h"

using namespace voussoir;

namespace {

Candidate candidate(double misfit, std::optional<double> posterior) {
  Candidate result;
  result.misfit = misfit;
  result.posterior = posterior;
  return result;
}

}  // namespace

TEST_CASE("Without probabilities a candidate is behind by the difference of misfits (written out)") {
  CHECK(behind(candidate(-3.25, {}), candidate(-4.5, {})) == "+1.2500");
  CHECK(behind(candidate(-4.5, {}), candidate(-4.5, {})) == "+0.0000");
}

TEST_CASE("With probabilities a candidate is behind by their ratio, whatever the misfits (written out)") {
  const Candidate best = candidate(-3.0, 0.75);
  CHECK(behind(candidate(-4.5, 0.25), best) == "1 : 3");
  CHECK(behind(candidate(-3.0, 0.75), best) == "1 : 1");
  CHECK(behind(candidate(-2.0, 0.75e-5), best) == "1 : 100000");
  CHECK(behind(candidate(-2.0, 0.75 / 18.532), best) == "1 : 18.5");
  CHECK(behind(candidate(-2.0, 0.75 / 10972.0), best) == "1 : 11000");
  CHECK(behind(candidate(-2.0, 1e-9), best) == "1 : > 10^6");
  CHECK(behind(candidate(-2.0, 0.0), best) == "negligible");
}

TEST_CASE("What stands against a verdict is said with it (written out)") {
  Answer answer = test::explained_answer({0.99, 0.01}, 0.01);
  answer.contested = true;
  CHECK(verdict_in_words(answer) ==
        "cannot-tell (the databases whose assumptions may hold come to different answers)");
  answer.contested = false;
  answer.prior = {{0}, {1.0}};
  CHECK(verdict_in_words(answer) == "cannot-tell (that no block is missing was supposed, not found)");
  answer = test::explained_answer({0.0, 1.0}, 0.4);
  for (const Prior& prior : {Prior{{1}, {1.0}}, Prior{{0, 1}, {0.0, 1.0}}}) {
    answer.prior = prior;
    CHECK(verdict_in_words(answer) == "cannot-tell (that blocks are missing was supposed, not found)");
  }
}

TEST_CASE("What is said to be intact is said with the losses that would hardly show (written out)") {
  Answer answer = test::explained_answer({0.995, 0.005}, 0.005);
  const test::SyntheticLibrary library(2, 3);
  const Comparison readings = absolute_readings(library.library(), no_measurements(library.points.size()));
  CHECK(headline(answer, readings) == "No block is missing (99.5 %).");
  answer.posterior->open_losses = {{1, 0.5}, {2, 0.2}};
  CHECK(headline(answer, readings) ==
        "Nothing shows that a block is missing (99.5 % that none is), but these readings do not exclude the "
        "loss of 2 blocks.");
  Comparison change = readings;
  change.kind = ReadingKind::change;
  CHECK(
      headline(answer, change) ==
      "Nothing shows that a block has gone between the two times (99.5 % that none has), but these readings "
      "do not exclude the loss of 2 blocks.");
}

TEST_CASE("Only numbers of missing blocks that were asked about are listed, and what was supposed is said") {
  const test::SyntheticLibrary library(2, 3);
  Answer answer = test::explained_answer({1.0, 0.0}, 0.0);
  answer.prior = {{0}, {1.0}};
  answer.searched = 1;
  answer.candidates = {candidate(-3.0, 1.0)};
  CHECK(missing_in_words(answer) == "0: > 99.9 %");
  CHECK(searched_in_words(answer) == "1 scene");
  CHECK(conclusions_in_words(answer, library.library()).front() ==
        "No scene is named: that no block is missing was supposed.");
}

TEST_CASE("Where the intact bridge is likeliest but not certain the likeliest loss is told (written out)") {
  const test::SyntheticLibrary library(2, 3);
  const std::size_t likeliest = library.row_of({{BlockId{4}}});
  Answer answer = test::explained_answer({0.7, 0.3}, 0.24);
  answer.posterior->probability = {0.0, {0, library.row_of({{BlockId{3}}}), likeliest}, {0.7, 0.06, 0.24}};
  answer.candidates = {candidate(-3.0, 0.7)};
  const auto told = [&] {
    const std::vector<std::string> all = conclusions_in_words(answer, library.library());
    return std::ranges::count(
        all, fmt::format("Of losses the likeliest is {} ({}), with 80.0 % of the probability of damage",
                         library.layout[BlockId{4}].label,
                         place_in_words(library.table.scene(likeliest), library.layout)));
  };
  CHECK(told() == 1);
  answer.posterior->missing_probability = {0.95, 0.05};
  answer.posterior->intact_if_even = 0.95;  // intact: no loss is told
  CHECK(told() == 0);
}

TEST_CASE("A database that was asked is told with its share, its digest and its verdict (written out)") {
  CHECK(in_words(AskedDatabase{.file = "a.h5",
                               .bridge = "bridge",
                               .digest = "0123456789abcdef",
                               .verdict = Verdict::located,
                               .first = "4,2"}) ==
        " < 0.1 %  a.h5 (digest 0123456789ab): located, first 4,2");
}

TEST_CASE(
    "Factors are told as per cent, other parameters with as many digits as they are known (written out)") {
  const double softer = std::log(0.5), twice = std::log(2.0);
  CHECK(in_words({"stiffness", "1", twice, softer, twice}) ==
        "stiffness: -50 % (-75 to +0 %), before -50 to +100 %");
  CHECK(in_words({"foot 1 dy", "m", 0.002, -0.00123, 0.00004}) ==
        "foot 1 dy: -1.230 +- 0.04 mm, before +- 2 mm");
  CHECK(in_words({"temperature", "K", 20.0, 12.34, 3.0}) == "temperature: +12.3 +- 3 K, before +- 20 K");
  CHECK(in_words({"foot 1 rotation", "rad", 0.0001, 0.0, 0.0}) ==
        "foot 1 rotation: +0.00 +- 0 mrad, before +- 0.1 mrad");
}
