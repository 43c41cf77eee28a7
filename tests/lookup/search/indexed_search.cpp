/// @file The search by the search index against the exhaustive search: rows, order and values must be the
/// same, always.

#include <catch2/catch.hpp>
#include <cmath>

#include "lookup/search/exhaustive_search.h"
#include "lookup/search/indexed_search.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::SyntheticLibrary;

namespace {

/// The search with what it needs to stay alive.
struct CheckedSearch {
  const SyntheticLibrary& library;
  Eligible eligible;
  IndexedSearch indexed{library.table, library.index.view(), library.points, eligible};

  CheckedSearch(const SyntheticLibrary& of, const std::vector<int>& missing)
      : library(of), eligible(eligible_rows(of.table, missing)) {}
  CheckedSearch(const CheckedSearch&) = delete;
  CheckedSearch& operator=(const CheckedSearch&) = delete;

  IndexedSearch::Result operator()(std::span<const double> readings, std::size_t count) const {
    return indexed.search(readings, count);
  }
  void check_same(std::span<const double> readings, std::size_t count) const {
    REQUIRE(indexed.search(readings, count).best ==
            exhaustive_search(readings, library.table, eligible.rows, count));
  }
};

}  // namespace

TEST_CASE(
    "Indexed search gives what exhaustive search gives, for noise of any size and any subset of sensors") {
  const SyntheticLibrary library(5, 9);
  const CheckedSearch search(library, {0, 1, 2});
  Random random(1);
  std::size_t scored = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    const double level = trial % 4 == 0 ? 0.0 : 0.5 * random.uniform() * random.uniform();
    auto readings = library.measure(truth, level, NoiseShape::uniform, random).displacement;
    if (trial % 3 == 0)
      for (double& value : readings)
        if (random.below(3) == 0) value = std::nan("");
    if (trial % 50 == 0) readings[1] = 10.0;  // far beyond all boxes
    search.check_same(readings, 1 + random.below(12));
    scored += search(readings, 3).scored;
  }
  CHECK(scored < 100 * library.table.rows);  // the bounds do rule out rows
}

TEST_CASE(
    "So many rows that parts are indexed and searched on their own: the same answers, triples among them") {
  const SyntheticLibrary library(7, 9, 3);
  REQUIRE(library.table.rows > 40'000);  // of 32,768 at most together
  const CheckedSearch search(library, {0, 1, 2, 3});
  Random random(3);
  std::size_t scored = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    const double level = trial % 2 == 0 ? 0.1 : 1.0;  // of the latter most clusters are within reach
    const auto readings =
        library.measure(truth, level * random.uniform(), NoiseShape::uniform, random).displacement;
    search.check_same(readings, 10);
    scored += search(readings, 10).scored;
  }
  CHECK(scored < 10 * library.table.rows);  // of 40
}

TEST_CASE("Indexed search keeps the order of rows among equal sums") {
  SyntheticLibrary library(5, 9);
  std::size_t copies = 0;  // of the intact scene, in scenes that have all points
  for (std::size_t row = 50; copies < 40; ++row) {
    const auto values = std::span(library.vertical).subspan(row * library.table.points, library.table.points);
    if (std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); })) continue;
    std::copy_n(library.vertical.begin(), values.size(), values.begin());
    ++copies;
  }
  library.make_index();
  const CheckedSearch search(library, {0, 1, 2});
  for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{50}})
    search.check_same(library.table.row(0), count);
}

TEST_CASE("Indexed search of some rows finds only these, and all of them when asked for more") {
  const SyntheticLibrary library(5, 9);
  Random random(2);
  const auto readings = library.measure(3, 0.02, NoiseShape::uniform, random).displacement;
  for (const int missing : {1, 2}) {  // few rows, which are all scored, and many
    const CheckedSearch search(library, {missing});
    search.check_same(readings, 5);
    search.check_same(readings, 5000);
    CHECK(search(readings, 0).best.empty());
  }
}

TEST_CASE("Where bounds say nothing the search scores every row, with the same answer") {
  const SyntheticLibrary library(5, 9);
  const CheckedSearch search(library, {0, 1, 2});
  const std::vector<double> readings(library.table.points,
                                     50.0);  // all beyond the boxes: sums have no upper bound
  search.check_same(readings, 5);
  CHECK(search(readings, 5).scored == library.table.rows);
}

TEST_CASE("Readings that are absurdly far lead to the same rows, order and values") {
  const SyntheticLibrary library(5, 9);
  const CheckedSearch search(library, {0, 1, 2});
  Random random(5);
  for (const double far : {1e-2, 1.0, 1e3, 1e6, 1e12}) {
    auto readings = library.measure(7, 0.05, NoiseShape::uniform, random).displacement;
    for (std::size_t i = 0; i < readings.size(); i += 3) readings[i] += far;
    search.check_same(readings, 7);
    search.check_same(std::vector<double>(readings.size(), far), 7);
  }
}
