/// @file The search by sketches against the exhaustive search: rows, order and values must be the same,
/// always.

#include <catch2/catch.hpp>
#include <cmath>

#include "lookup/exhaustive_search.h"
#include "lookup/sketch_search.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::all_rows;
using voussoir::test::SyntheticLibrary;

namespace {

void check_same(const SketchIndex& index, const SyntheticLibrary& library, std::span<const std::size_t> rows,
                std::span<const double> readings, std::size_t count) {
  REQUIRE(index.search(readings, count).best == exhaustive_search(readings, library.table, rows, count));
}

}  // namespace

TEST_CASE(
    "Sketch search gives what exhaustive search gives, for noise of any size and any subset of sensors") {
  const SyntheticLibrary library(5, 9);
  const auto rows = all_rows(library.table);
  const SketchIndex index(library.table, rows, library.intact());
  Random random(1);
  std::size_t scored = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    const double level = trial % 4 == 0 ? 0.0 : 0.5 * random.uniform() * random.uniform();
    auto readings = library.measure(truth, level, NoiseShape::uniform, random).displacement;
    if (trial % 3 == 0)
      for (double& value : readings)
        if (random.below(3) == 0) value = std::nan("");
    if (trial % 50 == 0) readings[1] = 10.0;  // far beyond the range of bytes
    check_same(index, library, rows, readings, 1 + random.below(12));
    scored += index.search(readings, 3).scored;
  }
  CHECK(scored < 200 * library.table.rows);  // the bounds do rule out rows
}

TEST_CASE("Sketch search keeps the order of rows among equal sums") {
  SyntheticLibrary library(3, 5);
  for (std::size_t row = 20; row < 60; ++row)
    std::copy_n(library.vertical.begin(), library.table.points,
                library.vertical.begin() + static_cast<std::ptrdiff_t>(row * library.table.points));
  const auto rows = all_rows(library.table);
  const SketchIndex index(library.table, rows, library.intact());
  for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{50}})
    check_same(index, library, rows, library.table.row(0), count);
}

TEST_CASE("Sketch search of some rows finds only these, and all of them when asked for more") {
  const SyntheticLibrary library(3, 5);
  const std::vector<std::size_t> rows = eligible_rows(library.table, {1}).rows;
  const SketchIndex index(library.table, rows, library.intact());
  Random random(2);
  const auto readings = library.measure(3, 0.02, NoiseShape::uniform, random).displacement;
  check_same(index, library, rows, readings, 5);
  check_same(index, library, rows, readings, 1000);
  CHECK(index.search(readings, 0).best.empty());
}

TEST_CASE("Where sketches say nothing the search falls back on scoring every row, with the same answer") {
  const SyntheticLibrary library(5, 9);
  const auto rows = all_rows(library.table);
  const SketchIndex index(library.table, rows, library.intact());
  std::vector<double> readings(library.table.points, 50.0);  // all beyond the range: every bound is the same
  check_same(index, library, rows, readings, 5);
  CHECK(index.search(readings, 5).fell_back);
}
