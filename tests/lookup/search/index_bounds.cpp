/// @file Clusters, boxes and sketches of the search index, and the bounds made of them, against the rows
/// themselves.

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "database/search/row_clusters.h"
#include "lookup/search/index_bounds.h"
#include "lookup/search/misfit.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::SyntheticLibrary;

namespace {

constexpr std::size_t kStride = 16;

/// Three groups of rows, far from each other, interleaved.
std::vector<float> three_groups(std::size_t rows) {
  Random random(3);
  std::vector<float> values(rows * kStride);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = 100.0F * static_cast<float>(i / kStride % 3) + static_cast<float>(random.uniform());
  return values;
}

double unit_of(const SearchIndex& index, std::size_t cluster) {
  return std::ldexp(1.0, index.exponent[cluster]);
}

/// sum |r - m| and what the sketch leaves of r - m, of one slot [units].
struct Apart {
  double distance = 0.0, lost = 0.0;
};
Apart apart(const SearchIndex& index, std::size_t cluster, std::size_t slot, std::span<const double> row) {
  Apart result;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (std::isnan(row[i])) continue;
    const double difference = row[i] / unit_of(index, cluster) - index.centre[cluster * index.places + i];
    result.distance += std::abs(difference);
    result.lost += std::abs(difference - index.bounds[slot].step() * index.sketch[slot * index.places + i]);
  }
  return result;
}

}  // namespace

TEST_CASE("Clusters hold every row once and do not mix groups that are far from each other") {
  const std::size_t rows = 100;
  const RowClusters clusters = cluster_rows(three_groups(rows), kStride, 20);
  std::vector<std::size_t> order = clusters.order;
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> all(rows);
  std::iota(all.begin(), all.end(), std::size_t{0});
  CHECK(order == all);
  REQUIRE(clusters.size() >= 5);
  for (std::size_t i = 0; i < clusters.size(); ++i)
    for (const std::size_t row : clusters.rows(i)) CHECK(row % 3 == clusters.rows(i).front() % 3);
}

TEST_CASE("Rows that are all the same are one cluster") {
  CHECK(cluster_rows(std::vector<float>(50 * kStride, 1.0F), kStride, 8).size() == 1);
}

TEST_CASE(
    "The search index has every row once, inside its cluster's box, at most at its distance, with its loss") {
  const SyntheticLibrary library(5, 9);
  const SearchIndex index = library.index.view();
  REQUIRE(index.clusters() > 10);
  CHECK(index.exponent.back() > index.exponent.front());  // collapses have a coarser unit
  std::vector<int> seen(library.table.rows, 0);
  for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster) {
    std::int32_t last = 65535;
    for (std::size_t slot = index.slot(cluster); slot < index.slot(cluster + 1); ++slot) {
      const auto which = static_cast<std::size_t>(index.row[slot]);
      const std::span<const double> row = library.table.row(which);
      ++seen[which];
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (std::isnan(row[i])) continue;
        REQUIRE(row[i] >= index.least[cluster * index.places + i] * unit_of(index, cluster));
        REQUIRE(row[i] <= index.most[cluster * index.places + i] * unit_of(index, cluster));
      }
      const SlotBounds& bounds = index.bounds[slot];
      const auto steps = index.sketch.subspan(slot * index.places, index.places);
      const Apart exact = apart(index, cluster, slot, row);
      REQUIRE(exact.distance <= bounds.distance() << index.coarseness[cluster]);
      REQUIRE(exact.lost <= bounds.start + bounds.step() * std::accumulate(steps.begin(), steps.end(), 0));
      REQUIRE(bounds.distance() <= last);
      last = bounds.distance();
    }
  }
  CHECK(seen == std::vector<int>(library.table.rows, 1));
}

TEST_CASE("Bounds of rows hold their sums between them, closely, and a limit leaves out no row within it") {
  const SyntheticLibrary library(5, 9);
  const SearchIndex index = library.index.view();
  RowBounds bounds(index, largest_cluster(index));
  Random random(7);
  std::size_t left_out = 0;
  for (int trial = 0; trial < 90; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    auto readings = library.measure(truth, 0.3 * random.uniform(), NoiseShape::uniform, random).displacement;
    if (trial % 3 == 0) readings[random.below(static_cast<std::uint32_t>(readings.size()))] = std::nan("");
    for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster) {
      const UnitReadings rounded = round_readings(readings, index.places, index.exponent[cluster]);
      std::int32_t distance = 0;
      least_distances(rounded, index.centre.subspan(cluster * index.places, index.places), {&distance, 1});
      const std::int32_t limit = trial % 2 == 0 ? 1 << 28 : static_cast<std::int32_t>(random.below(20000));
      std::vector<bool> is_found(index.rows(cluster), false);
      for (const RowBound& one : bounds.within(cluster, rounded, distance, limit)) {
        const double sum =
            sum_of_differences(readings, library.table.row(static_cast<std::size_t>(index.row[one.slot]))) /
            unit_of(index, cluster);
        is_found[one.slot - index.slot(cluster)] = true;
        REQUIRE(one.least <= limit);
        if (!std::isfinite(sum)) continue;
        REQUIRE(one.least <= sum);
        REQUIRE(sum <= one.most);
        if (!rounded.is_cut_off) REQUIRE(one.most - one.least <= 60 + 0.02 * sum);
      }
      for (std::size_t i = 0; i < is_found.size(); ++i) {
        const auto row = static_cast<std::size_t>(index.row[index.slot(cluster) + i]);
        const double sum = sum_of_differences(readings, library.table.row(row)) / unit_of(index, cluster);
        if (sum <= limit) REQUIRE(is_found[i]);
        left_out += is_found[i] ? 0 : 1;
      }
    }
  }
  CHECK(left_out > 10000);  // limits do leave out rows
}
