/// @file Made-up triples. Oracle: the sum of what pairs and singles show, found by their scenes; the scan of
/// all rows.

#include "tools/benchmarks/triples_library.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "lookup/search/exhaustive_search.h"
#include "lookup/search/indexed_search.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using namespace voussoir::test;

namespace {

/// To round-off; NaN is NaN.
bool same(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : a == Approx(b).epsilon(1e-12);
}

}  // namespace

TEST_CASE("Made-up triples are what pairs and singles add up to, and stand where all of these do") {
  const SyntheticLibrary pairs(2, 4);
  const TriplesLibrary triples(pairs.library());
  const SceneTable &table = triples.library().table, &parts = pairs.table;
  REQUIRE(table.rows == 1 + 8 + 28 + 56);
  std::size_t standing = 0;
  for (std::size_t row = 0; row < table.rows; ++row) {
    const Scene scene = table.scene(row);
    REQUIRE(table.find(scene) == row);
    if (scene.missing() < 3) {
      const std::size_t own = *parts.find(scene);
      CHECK(table.stands(row) == parts.stands(own));
      CHECK(same(table.row(row).front(), parts.row(own).front()));
      continue;
    }
    std::vector<double> sum(table.points, 0.0);
    bool stands = true;
    const auto add = [&](const Scene& part, double sign) {
      const std::size_t own = *parts.find(part);
      stands = stands && parts.stands(own);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sign * parts.row(own)[i];
    };
    for (std::size_t k = 0; k < 3; ++k) {
      Scene pair = scene;
      pair.removed.erase(pair.removed.begin() + static_cast<std::ptrdiff_t>(k));
      add(pair, 1.0);
      add({{scene.removed[k]}}, -1.0);
    }
    add({}, 1.0);
    REQUIRE(table.stands(row) == stands);
    standing += stands ? 1 : 0;
    for (std::size_t i = 0; i < sum.size(); ++i)
      CHECK(same(table.row(row)[i], stands ? sum[i] : std::nan("")));
  }
  CHECK(standing > 0);
  CHECK(standing < 56);
}

TEST_CASE("The index of made-up triples finds what a scan finds") {
  const SyntheticLibrary pairs(2, 4);
  const TriplesLibrary triples(pairs.library());
  const Library& library = triples.library();
  const Eligible eligible = eligible_rows(library.table, numbers_of_missing(library.table));
  const IndexedSearch search(library.table, library.index, library.points, eligible);
  NoiseModel noise{NoiseShape::uniform, 0.05};
  noise.silence = 0.0;
  Random random(1);
  for (std::size_t row = 0; row < library.table.rows; row += 5) {
    if (!library.table.has_displacements(row)) continue;
    const Measurements measured = simulate_readings(library.table.row(row), noise, random);
    CHECK(search.search(measured.displacement, 10).best ==
          exhaustive_search(measured.displacement, library.table, eligible.rows, 10));
  }
}

TEST_CASE("Triples are not made up from less than all pairs") {
  const SyntheticLibrary singles(2, 3, 1);
  CHECK_THROWS_AS(TriplesLibrary(singles.library()), Failure);
}
