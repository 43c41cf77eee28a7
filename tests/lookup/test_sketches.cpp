/// @file Clusters and sketches of rows against the rows themselves.

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "lookup/misfit.h"
#include "lookup/row_patterns.h"
#include "lookup/sketches.h"
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

RowClusters clusters_of(const SyntheticLibrary& library, std::size_t most) {
  const std::size_t points = library.table.points;
  const std::size_t stride = (points + kSketchPlaces - 1) / kSketchPlaces * kSketchPlaces;
  std::vector<float> values(library.table.rows * stride, 0.0F);
  for (std::size_t i = 0; i < library.vertical.size(); ++i)
    if (!std::isnan(library.vertical[i]))
      values[i / points * stride + i % points] = static_cast<float>(library.vertical[i]);
  return cluster_rows(values, stride, most);
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

TEST_CASE("No bound of a sketch is above the sum of differences, and without a limit every row has one") {
  const SyntheticLibrary library(5, 9);
  const std::size_t points = library.table.points;
  const Sketches sketches(library.vertical, points, clusters_of(library, 24));
  Random random(7);
  double closest = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t truth = random.below(static_cast<std::uint32_t>(library.table.rows));
    auto readings = library.measure(truth, 0.3 * random.uniform(), NoiseShape::uniform, random).displacement;
    if (trial % 3 == 0) readings[random.below(static_cast<std::uint32_t>(points))] = std::nan("");
    SketchReadings prepared(readings);
    const std::vector<float> distances = prepared.distances(sketches.centres());
    std::vector<RowBound> found;
    for (std::size_t i = 0; i < sketches.clusters(); ++i)
      sketches.append_within(prepared, i, distances[i], std::numeric_limits<float>::max(), found);
    REQUIRE(found.size() == library.table.rows);
    for (const RowBound& one : found) {
      const double sum = sum_of_differences(readings, library.table.row(one.row));
      REQUIRE(static_cast<double>(one.bound) <= sum);
      if (std::isfinite(sum)) closest = std::max(closest, static_cast<double>(one.bound) / sum);
    }
  }
  CHECK(closest > 0.99);
}

TEST_CASE("A limit leaves out no row whose sum is within it") {
  const SyntheticLibrary library(5, 9);
  const Sketches sketches(library.vertical, library.table.points, clusters_of(library, 24));
  Random random(8);
  const auto readings = library.measure(40, 0.05, NoiseShape::uniform, random).displacement;
  const std::vector<double> sums = sums_of_differences(readings, library.table);
  SketchReadings prepared(readings);
  const std::vector<float> distances = prepared.distances(sketches.centres());
  for (const float limit : {0.5e-3F, 1e-3F, 2e-3F, 5e-3F}) {
    std::vector<RowBound> found;
    for (std::size_t i = 0; i < sketches.clusters(); ++i)
      if (sketches.may_hold(i, prepared, distances[i], limit))
        sketches.append_within(prepared, i, distances[i], limit, found);
    std::vector<bool> is_found(library.table.rows, false);
    for (const RowBound& one : found) is_found[one.row] = true;
    for (std::size_t row = 0; row < sums.size(); ++row)
      if (sums[row] <= static_cast<double>(limit)) CHECK(is_found[row]);
    CHECK(found.size() < library.table.rows);
  }
}

TEST_CASE("A row lacks a reading exactly if its sum of differences is infinite") {
  const SyntheticLibrary library(4, 7);
  const RowPatterns patterns(library.vertical, library.table.points);
  Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> readings(library.table.points, 1e-3);
    for (double& value : readings)
      if (random.below(2) == 0) value = std::nan("");
    const auto lacking = patterns.lacking(readings);
    for (std::size_t row = 0; row < library.table.rows; ++row)
      REQUIRE((lacking[patterns.of(row)] != 0) ==
              std::isinf(sum_of_differences(readings, library.table.row(row))));
  }
}
