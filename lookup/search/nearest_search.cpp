#include "lookup/search/nearest_search.h"

#include <algorithm>
#include <cmath>
#include <flann/flann.hpp>

#include "lookup/search/misfit.h"

namespace voussoir {
namespace {

constexpr double kRounding = 1e-12;  // relative: FLANN adds differences in another order than misfit() does

using FlannIndex = flann::Index<flann::L1<double>>;

std::vector<std::size_t> measured_points(std::span<const double> readings) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (!std::isnan(readings[i])) result.push_back(i);
  return result;
}

}  // namespace

struct LinearIndex::Implementation {
  const SceneTable& table;
  std::vector<std::size_t> points;  // with readings
  std::vector<std::size_t> rows;    // in the index
  std::vector<double> values;       // rows x points
  std::unique_ptr<FlannIndex> index;

  Implementation(const SceneTable& scene_table, std::span<const std::size_t> candidates,
                 std::span<const double> readings)
      : table(scene_table), points(measured_points(readings)) {
    for (const std::size_t row : candidates)
      if (std::isfinite(sum_of_differences(readings, table.row(row)))) rows.push_back(row);
    values.reserve(rows.size() * points.size());
    for (const std::size_t row : rows)
      for (const std::size_t point : points) values.push_back(table.row(row)[point]);
    if (rows.empty() || points.empty()) return;
    index = std::make_unique<FlannIndex>(flann::Matrix<double>(values.data(), rows.size(), points.size()),
                                         flann::LinearIndexParams());
    index->buildIndex();
  }

  /// The nearest rows by FLANN's own distance, and that of the last of them.
  struct Neighbours {
    std::vector<std::size_t> rows;
    std::vector<double> distances;
  };
  Neighbours neighbours(std::span<const double> readings, std::size_t count) const {
    std::vector<double> query;
    for (const std::size_t point : points) query.push_back(readings[point]);
    std::vector<std::vector<std::size_t>> found;
    std::vector<std::vector<double>> distances;
    index->knnSearch(flann::Matrix<double>(query.data(), 1, query.size()), found, distances, count,
                     flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    Neighbours result{{}, distances.front()};
    for (const std::size_t position : found.front()) result.rows.push_back(rows[position]);
    return result;
  }

  /// Enough neighbours that none beyond them can be among the best `count` after rescoring.
  std::vector<std::size_t> candidates(std::span<const double> readings, std::size_t count) const {
    for (std::size_t fetched = std::min(rows.size(), count + 1);;
         fetched = std::min(rows.size(), 2 * fetched)) {
      Neighbours found = neighbours(readings, fetched);
      const bool cut_is_clear =
          found.distances.back() > found.distances[std::min(count, fetched) - 1] * (1.0 + kRounding);
      if (cut_is_clear || fetched == rows.size()) return found.rows;
    }
  }
};

LinearIndex::LinearIndex(const SceneTable& table, std::span<const std::size_t> rows,
                         std::span<const double> readings)
    : implementation_(std::make_unique<Implementation>(table, rows, readings)) {}
LinearIndex::~LinearIndex() = default;

std::vector<ScoredRow> LinearIndex::search(std::span<const double> readings, std::size_t count) const {
  if (!implementation_->index || count == 0) return {};
  std::vector<ScoredRow> scored;
  for (const std::size_t row : implementation_->candidates(readings, count))
    scored.push_back({row, sum_of_differences(readings, implementation_->table.row(row))});
  return best_rows(std::move(scored), count);
}

}  // namespace voussoir
