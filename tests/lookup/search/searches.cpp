/// @file Every search against the exhaustive one, and the exhaustive one against a full sort.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "core/random.h"
#include "lookup/search/exhaustive_search.h"
#include "lookup/search/genetic_search.h"
#include "lookup/search/nearest_search.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::all_rows;
using voussoir::test::SyntheticLibrary;

namespace {

std::vector<ScoredRow> full_sort(std::span<const double> readings, const SceneTable& table,
                                 std::size_t count) {
  std::vector<ScoredRow> scored;
  for (std::size_t row = 0; row < table.rows; ++row) {
    const double sum = sum_of_differences(readings, table.row(row));
    if (std::isfinite(sum)) scored.push_back({row, sum});
  }
  std::sort(scored.begin(), scored.end(), [](const ScoredRow& a, const ScoredRow& b) {
    return a.sum != b.sum ? a.sum < b.sum : a.row < b.row;
  });
  scored.resize(std::min(count, scored.size()));
  return scored;
}

std::vector<std::size_t> rows_with(const SceneTable& table, int missing) {
  return eligible_rows(table, {missing}).rows;
}

}  // namespace

TEST_CASE("Exhaustive search gives the head of the fully sorted list") {
  const SyntheticLibrary library(4, 7);
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    const auto readings = library.measure(truth, 0.1, NoiseShape::uniform, random).displacement;
    const std::size_t count = 1 + random.below(30);
    REQUIRE(exhaustive_search(readings, library.table, all_rows(library.table), count) ==
            full_sort(readings, library.table, count));
  }
}

TEST_CASE("Exhaustive search finds every scene from its own displacements") {
  const SyntheticLibrary library(4, 7);
  for (std::size_t row = 0; row < library.table.rows; ++row) {
    const auto found = exhaustive_search(library.table.row(row), library.table, all_rows(library.table), 1);
    REQUIRE(found.front().sum == 0.0);
    REQUIRE(found.front().row == row);
  }
}

TEST_CASE("Rows that are not eligible are never found") {
  const SyntheticLibrary library(4, 7);
  const auto found = exhaustive_search(library.table.row(0), library.table, rows_with(library.table, 1), 5);
  for (const ScoredRow& row : found) CHECK(missing_blocks(library.table, row.row) == 1);
}

TEST_CASE("Nearest-neighbour search gives rows, order and values of the exhaustive search") {
  const SyntheticLibrary library(4, 7);
  Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    auto readings = library.measure(truth, 0.1, NoiseShape::uniform, random).displacement;
    for (double& value : readings)
      if (random.below(4) == 0) value = std::nan("");
    const auto rows = all_rows(library.table);
    const LinearIndex index(library.table, rows, readings);
    REQUIRE(index.search(readings, 10) == exhaustive_search(readings, library.table, rows, 10));
  }
}

TEST_CASE("Nearest-neighbour search keeps the order of rows among equal distances") {
  SyntheticLibrary library(3, 5);
  for (std::size_t row = 20; row < 60; ++row)  // forty copies of one scene
    std::copy_n(library.vertical.begin(), library.table.points,
                library.vertical.begin() + static_cast<std::ptrdiff_t>(row * library.table.points));
  const auto rows = all_rows(library.table);
  const std::span<const double> readings = library.table.row(0);
  CHECK(LinearIndex(library.table, rows, readings).search(readings, 15) ==
        exhaustive_search(readings, library.table, rows, 15));
}

TEST_CASE("Genetic search reaches the exhaustive minimum for one to three blocks in at least 95 % of seeds") {
  const SyntheticLibrary library(5, 8, 3);
  const GeneSpace space(library.layout, library.table);
  Random random(17);
  for (const int missing : {1, 2, 3}) {
    const auto rows = rows_with(library.table, missing);
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const std::size_t truth = rows[random.below(static_cast<std::uint32_t>(rows.size()))];
      const auto readings = library.measure(truth, 0.05, NoiseShape::uniform, random).displacement;
      const auto best = exhaustive_search(readings, library.table, rows, 1).front();
      GeneticSettings settings;
      settings.seed = seed;
      hits +=
          genetic_search(readings, library.table, space, missing, settings, 1).best.front() == best ? 1 : 0;
    }
    INFO(missing << " missing blocks");
    CHECK(hits >= 95);
  }
}

TEST_CASE("Genetic search repeats itself for a seed, counts generations, and reports true misfits") {
  const SyntheticLibrary library(5, 8);
  const GeneSpace space(library.layout, library.table);
  Random random(19);
  const auto readings = library.measure(300, 0.05, NoiseShape::uniform, random).displacement;
  const GeneticResult first = genetic_search(readings, library.table, space, 2, {}, 10);
  const GeneticResult second = genetic_search(readings, library.table, space, 2, {}, 10);
  CHECK(first.best == second.best);
  CHECK(first.converged == second.converged);
  CHECK(first.generations == GeneticSettings{}.most_generations);
  CHECK(first.converged <= first.generations);
  for (const ScoredRow& row : first.best) {
    CHECK(missing_blocks(library.table, row.row) == 2);
    CHECK(row.sum == sum_of_differences(readings, library.table.row(row.row)));
  }
}

TEST_CASE("A mutation leads half of the time to a neighbour and half of the time to any block, all alike") {
  const SyntheticLibrary library(9, 9);
  const GeneSpace space(library.layout, library.table);
  Random random(29);
  constexpr int kMutations = 100'000;
  constexpr std::array<int, 2> kMiddle = {5, 5};  // two steps from the middle do not leave the wall
  std::map<std::array<int, 2>, int> counts;
  for (int i = 0; i < kMutations; ++i) {
    std::array<int, 2> block = kMiddle;
    mutate_block(block, space, random);
    ++counts[block];
  }
  // Anywhere: a course of ten (course 0 has no block, and position 1 stands for it), then one of nine places.
  // To neighbours: one of two genes by one of -2, -1, 1, 2.
  const auto share = [&](int course, int position) {
    const bool near = (course == kMiddle[0]) != (position == kMiddle[1]) &&
                      std::abs(course - kMiddle[0]) + std::abs(position - kMiddle[1]) <= 2;
    return 0.5 / 10.0 / 9.0 + (near ? 0.5 / 8.0 : 0.0);
  };
  for (int course = 1; course <= 9; ++course)
    for (int position = 1; position <= 9; ++position) {
      const double expected = kMutations * share(course, position);
      INFO(course << "," << position);
      CHECK(counts[{course, position}] == Approx(expected).margin(5.0 * std::sqrt(expected)));
    }
  CHECK(counts[{0, 1}] == Approx(kMutations * 0.05).margin(5.0 * std::sqrt(kMutations * 0.05)));
  CHECK(counts.size() == 82);
}

TEST_CASE("Mutations of blocks at the end of their range stay within it") {
  const SyntheticLibrary library(3, 5);
  const GeneSpace space(library.layout, library.table);
  Random random(31);
  for (int i = 0; i < 1000; ++i) {
    std::array<int, 2> block = i % 2 == 0 ? std::array{1, 1} : std::array{3, 5};
    mutate_block(block, space, random);
    REQUIRE((block[0] >= 0 && block[0] <= 3 && block[1] >= 1 && block[1] <= 5));
  }
}

TEST_CASE("Genes name the rows of their scenes in any order of blocks, and no row for what is no scene") {
  const SyntheticLibrary library(3, 5);
  const GeneSpace space(library.layout, library.table);
  CHECK(space.row(std::vector<int>{1, 2}) == library.row_of({{BlockId{1}}}));
  CHECK(space.row(std::vector<int>{2, 1, 1, 2}) == library.row_of({{BlockId{1}, BlockId{5}}}));
  CHECK(space.row(std::vector<int>{1, 2, 2, 1}) == space.row(std::vector<int>{2, 1, 1, 2}));
  CHECK(space.row(std::vector<int>{1, 2, 1, 2}) == GeneSpace::none);
  CHECK(space.row(std::vector<int>{1, 6}) == GeneSpace::none);
}

TEST_CASE("Genes of three blocks name the row that a search through all scenes finds") {
  SyntheticLibrary library(3, 4, 3);
  library.outcome[library.row_of({{BlockId{0}, BlockId{5}, BlockId{9}}})] =
      static_cast<std::uint8_t>(Outcome::unresolved);
  const GeneSpace space(library.layout, library.table);
  Random random(37);
  const auto any = [&](int count) {
    return static_cast<int>(random.below(static_cast<std::uint32_t>(count)));
  };
  for (int i = 0; i < 2000; ++i) {
    const std::set<int> blocks = {any(12), any(12), any(12)};  // fewer: named twice
    if (blocks.size() < 3) continue;
    std::vector<int> genes;
    for (const int block : blocks) genes.insert(genes.end(), {1 + block / 4, 1 + block % 4});
    std::size_t wanted = GeneSpace::none;
    for (std::size_t row = 0; row < library.table.rows; ++row) {
      const Scene scene = library.table.scene(row);
      const bool has_all =
          std::ranges::all_of(blocks, [&](int block) { return scene.lacks(BlockId{block}); });
      if (has_all && scene.missing() == 3 &&
          library.outcome[row] != static_cast<std::uint8_t>(Outcome::unresolved))
        wanted = row;
    }
    REQUIRE(space.row(genes) == wanted);
  }
  CHECK(space.row(std::vector<int>{1, 1, 2, 2, 3, 2}) == GeneSpace::none);  // unresolved
}

TEST_CASE("Random numbers are those of the published generator") {
  // First outputs of PCG32 for this state and stream, from the paper's definition.
  Random random(42);
  std::uint64_t state = 42 + 1442695040888963407ULL;
  for (int i = 0; i < 100; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const std::uint64_t mixed = ((state >> 18U) ^ state) >> 27U;
    const auto word = static_cast<std::uint32_t>(mixed);
    const auto turn = static_cast<unsigned>(state >> 59U);
    const std::uint32_t expected = turn == 0 ? word : (word >> turn) | (word << (32U - turn));
    REQUIRE(random.bits() == expected);
  }
}

TEST_CASE("Uniform numbers are even and Gaussian numbers have mean zero and variance one") {
  Random random(23);
  double sum = 0.0, square = 0.0;
  std::vector<int> counts(7, 0);
  constexpr int kDraws = 70'000;
  for (int i = 0; i < kDraws; ++i) {
    const double z = random.gaussian();
    sum += z;
    square += z * z;
    ++counts[random.below(7)];
  }
  CHECK(sum / kDraws == Approx(0.0).margin(4.0 / std::sqrt(kDraws)));
  CHECK(square / kDraws == Approx(1.0).margin(4.0 * std::sqrt(2.0 / kDraws)));
  for (const int count : counts) CHECK(count == Approx(kDraws / 7.0).margin(4.0 * std::sqrt(kDraws / 7.0)));
}

TEST_CASE("The genetic search refuses scenes with more missing blocks than it has genes for") {
  const SyntheticLibrary library(2, 3, 4);
  const GeneSpace space(library.layout, library.table);
  CHECK_NOTHROW(genetic_search(library.intact(), library.table, space, 3, {}, 1));
  CHECK_THROWS_WITH(genetic_search(library.intact(), library.table, space, 4, {}, 1),
                    "--search genetic among scenes with 4 missing blocks, expected at most 3 (--missing)");
}
