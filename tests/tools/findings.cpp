/// Findings are judged by their numbers, in both directions.

#include <catch2/catch.hpp>
#include <cmath>

#include "tools/reproduction/findings.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

PairSuccess pairs(int first, int trials) {
  PairSuccess success;
  success.misfit = {trials, first, first, 0};
  success.known = success.misfit;
  return success;
}

CaseResult result(const std::string& scene, int found, int trials) {
  CaseResult result;
  result.paper_case = {scene, 0.05, ""};
  result.paper_objective.trials = trials;
  result.genetic_found = found;
  return result;
}

}  // namespace

TEST_CASE("Rank correlation has Spearman's values: +1, -1, ties by mean ranks, 0 for a constant") {
  CHECK(rank_correlation({1, 2, 3, 4}, {10, 100, 1000, 1e4}) == Approx(1.0));
  CHECK(rank_correlation({1, 2, 3, 4}, {4, 3, 2, 1}) == Approx(-1.0));
  CHECK(rank_correlation({1, 2, 3, 4, 5}, {1, 3, 2, 5, 4}) == Approx(0.8));  // 1 - 6 * 4 / (5 * 24)
  CHECK(rank_correlation({1, 2, 2, 3}, {1, 2, 3, 4}) == Approx(4.5 / std::sqrt(4.5 * 5.0)));
  CHECK(rank_correlation({1, 1, 1}, {1, 2, 3}) == 0.0);
}

TEST_CASE("An arch block hides a second one if pairs with one are found less often, and only then") {
  CHECK(arch_blocks_mask(pairs(10, 100), pairs(60, 100)).holds);
  CHECK_FALSE(arch_blocks_mask(pairs(60, 100), pairs(10, 100)).holds);
  CHECK_FALSE(arch_blocks_mask(pairs(50, 100), pairs(55, 100)).holds);  // 0.7 standard errors
  CHECK_THAT(arch_blocks_mask(pairs(10, 100), pairs(60, 100)).evidence, Contains("10 % of 100"));
}

TEST_CASE("High blocks are easier if the upper courses succeed more often, and only then") {
  const auto courses = [](int low, int high) {
    std::vector<CourseSuccess> list;
    for (int course = 1; course <= 4; ++course)
      list.push_back({course, {100, course <= 2 ? low : high, 0, 0}, {100, 0, 0, 0}});
    return list;
  };
  CHECK(high_blocks_are_easier(courses(40, 70)).holds);
  CHECK_FALSE(high_blocks_are_easier(courses(70, 40)).holds);
  CHECK_FALSE(high_blocks_are_easier(courses(50, 50)).holds);
}

TEST_CASE("A pair is hard if few seeds find it and most others are easier") {
  const PaperCase pair{"4,10+2,6", 0.05, "-"};
  CHECK(pair_is_hard(pair, {result("4,10+2,6", 10, 50), result("1,1+2,2", 40, 50), result("3,3+4,4", 5, 50),
                            result("5,5+6,6", 50, 50)})
            .holds);
  CHECK_FALSE(pair_is_hard(pair, {result("4,10+2,6", 45, 50), result("1,1+2,2", 50, 50)}).holds);
  CHECK_FALSE(pair_is_hard(pair, {result("4,10+2,6", 10, 50), result("1,1+2,2", 5, 50)}).holds);
}

TEST_CASE("Noise raises generations if they rise with it over the runs that find the truth") {
  std::vector<GenerationsAtNoise> rising, flat;
  for (int level = 0; level < 10; ++level) {
    rising.push_back({0.01 * level, 5, {level + 1, level + 2, level + 3}});
    flat.push_back({0.01 * level, 5, {1, 2, 3}});
  }
  CHECK(noise_raises_generations(rising).holds);
  CHECK_FALSE(noise_raises_generations(flat).holds);
}
