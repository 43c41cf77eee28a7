#include "lookup/nearest_search.h"

#include <algorithm>
#include <cmath>
#include <flann/flann.hpp>

#include "lookup/misfit.h"

namespace voussoir {
namespace {

constexpr double kRounding = 1e-12;  // relative: FLANN adds differences in another order than misfit() does
constexpr long kTreeSeed = 1;        // of FLANN's own generator, so that trees are the same each time

using Index = flann::Index<flann::L1<double>>;

std::vector<std::size_t> measured_points(std::span<const double> readings) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (!std::isnan(readings[i])) result.push_back(i);
  return result;
}

flann::IndexParams parameters(const NearestSettings& settings) {
  if (settings.mode == NearestMode::exact) return flann::LinearIndexParams();
  return flann::KDTreeIndexParams(settings.trees);
}

}  // namespace

struct NearestIndex::Implementation {
  const SceneTable& table;
  NearestSettings settings;
  std::vector<std::size_t> points;  // with readings
  std::vector<std::size_t> rows;    // in the index
  std::vector<double> values;       // rows x points
  std::unique_ptr<Index> index;

  Implementation(const SceneTable& scene_table, std::span<const std::size_t> candidates,
                 std::span<const double> readings, const NearestSettings& chosen)
      : table(scene_table), settings(chosen), points(measured_points(readings)) {
    for (const std::size_t row : candidates)
      if (std::isfinite(sum_of_differences(readings, table.row(row)))) rows.push_back(row);
    values.reserve(rows.size() * points.size());
    for (const std::size_t row : rows)
      for (const std::size_t point : points) values.push_back(table.row(row)[point]);
    if (rows.empty() || points.empty()) return;
    flann::seed_random(kTreeSeed);
    index = std::make_unique<Index>(flann::Matrix<double>(values.data(), rows.size(), points.size()),
                                    parameters(settings));
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
    const int checks = settings.mode == NearestMode::exact ? flann::FLANN_CHECKS_UNLIMITED : settings.checks;
    index->knnSearch(flann::Matrix<double>(query.data(), 1, query.size()), found, distances, count,
                     flann::SearchParams(checks));
    Neighbours result{{}, distances.front()};
    for (const std::size_t position : found.front()) result.rows.push_back(rows[position]);
    return result;
  }

  /// Enough neighbours that none beyond them can be among the best `count` after rescoring (exact mode).
  std::vector<std::size_t> candidates(std::span<const double> readings, std::size_t count) const {
    if (settings.mode == NearestMode::approximate)
      return neighbours(readings, std::min(rows.size(), count * settings.oversampling)).rows;
    for (std::size_t fetched = std::min(rows.size(), count + 1);;
         fetched = std::min(rows.size(), 2 * fetched)) {
      Neighbours found = neighbours(readings, fetched);
      const bool cut_is_clear =
          found.distances.back() > found.distances[std::min(count, fetched) - 1] * (1.0 + kRounding);
      if (cut_is_clear || fetched == rows.size()) return found.rows;
    }
  }
};

NearestIndex::NearestIndex(const SceneTable& table, std::span<const std::size_t> rows,
                           std::span<const double> readings, const NearestSettings& settings)
    : implementation_(std::make_unique<Implementation>(table, rows, readings, settings)) {}
NearestIndex::~NearestIndex() = default;
NearestIndex::NearestIndex(NearestIndex&&) noexcept = default;
NearestIndex& NearestIndex::operator=(NearestIndex&&) noexcept = default;

std::vector<ScoredRow> NearestIndex::search(std::span<const double> readings, std::size_t count) const {
  if (!implementation_->index || count == 0) return {};
  std::vector<ScoredRow> scored;
  for (const std::size_t row : implementation_->candidates(readings, count))
    scored.push_back({row, sum_of_differences(readings, implementation_->table.row(row))});
  return best_rows(std::move(scored), count);
}

}  // namespace voussoir
