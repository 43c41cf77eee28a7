#include "lookup/evidence/evidence_screen.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>

#include "lookup/evidence/cluster_bounds.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/level_screen.h"
#include "lookup/evidence/row_blocks.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/search/exhaustive_search.h"
#include "lookup/search/index_bounds.h"
#include "lookup/search/misfit.h"

namespace voussoir {
namespace {

/// So many clusters' rows are worked out first; more if they hold too few possible scenes.
constexpr std::array<std::size_t, 2> kClustersFirst = {4, 32};
constexpr std::size_t kLikelyClusters = 8;  // whose rows nearest to the readings, so many,
constexpr std::size_t kLikelyRows = 16;     // say where an unknown level lies

/// The sum of |reading - centre| for each cluster [m].
std::vector<double> distances_from(std::span<const double> readings, const SearchIndex& index) {
  std::vector<std::int32_t> units(index.clusters());
  std::vector<double> metres(index.clusters());
  for (const UnitClusters& unit : clusters_by_unit(index)) {
    const std::size_t count = unit.last - unit.first;
    least_distances(round_readings(readings, index.places, unit.exponent),
                    index.centre.subspan(unit.first * index.places, count * index.places),
                    std::span(units).subspan(unit.first, count));
    for (std::size_t i = unit.first; i < unit.last; ++i) metres[i] = unit.metres * units[i];
  }
  return metres;
}

/// What is below does not matter beside these evidences of some rows.
double least_beside(std::vector<double> values, std::size_t count, std::size_t rows) {
  std::partial_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count), values.end(),
                    std::greater<>());
  return std::min(values[count - 1], values.front() + std::log(kScreenedAway / static_cast<double>(rows)));
}

/// Those that have a prediction for every reading: the others are infinitely far from the readings.
std::vector<std::size_t> possible_rows(const Observation& observation, const SceneTable& table,
                                       std::span<const std::size_t> rows) {
  std::vector<double> distance(rows.size());
  for_row_blocks_on_threads(rows, [&](std::span<const std::size_t> block) {
    std::ranges::copy(sums_of_differences(observation.reading, table, block),
                      distance.begin() + (block.data() - rows.data()));
  });
  std::vector<std::size_t> result;
  result.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::isfinite(distance[i])) result.push_back(rows[i]);
  return result;
}

}  // namespace

EvidenceScreen::EvidenceScreen(const SceneTable& table, const SearchIndex& index, const Eligible& eligible,
                               const Prior& prior)
    : table_(table),
      index_(index),
      eligible_(eligible),
      priors_{std::vector<double>(table.rows, kImpossible),
              std::vector<double>(index.clusters(), kImpossible)},
      gaussian_(table, index) {
  const std::vector<double> by_missing = log_prior_by_missing(table, eligible, prior);
  for (std::size_t i = 0; i < eligible.rows.size(); ++i)
    priors_.row[eligible.rows[i]] = by_missing[eligible.missing[i]];
  for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster)
    for (const std::int32_t row : index.row.subspan(index.slot(cluster), index.rows(cluster)))
      priors_.cluster[cluster] =
          std::max(priors_.cluster[cluster], priors_.row[static_cast<std::size_t>(row)]);
}

/// Rows in ascending order: as they stand in memory, one after the other.
std::vector<std::size_t> EvidenceScreen::in_order(std::span<const std::size_t> rows) const {
  constexpr std::size_t kBits = 64;
  std::vector<std::uint64_t> marks((table_.rows + kBits - 1) / kBits, 0);
  for (const std::size_t row : rows) marks[row / kBits] |= std::uint64_t{1} << row % kBits;
  std::vector<std::size_t> result;
  result.reserve(rows.size());
  for (std::size_t word = 0; word < marks.size(); ++word)
    for (std::uint64_t left = marks[word]; left != 0; left &= left - 1)
      result.push_back(word * kBits + static_cast<std::size_t>(std::countr_zero(left)));
  return result;
}

/// The eligible rows of some clusters, in ascending order.
std::vector<std::size_t> EvidenceScreen::rows_of(std::span<const std::size_t> clusters) const {
  std::vector<std::size_t> rows;
  for (const std::size_t cluster : clusters)
    for (const std::int32_t row : index_.row.subspan(index_.slot(cluster), index_.rows(cluster)))
      if (priors_.row[static_cast<std::size_t>(row)] > kImpossible)
        rows.push_back(static_cast<std::size_t>(row));
  return in_order(rows);
}

/// The clusters with the centres nearest to the readings.
std::vector<std::size_t> EvidenceScreen::nearest_clusters(const Observation& observation,
                                                          std::size_t count) const {
  const std::vector<double> distance = distances_from(observation.reading, index_);
  std::vector<std::size_t> clusters(distance.size());
  std::iota(clusters.begin(), clusters.end(), std::size_t{0});
  count = std::min(count, clusters.size());
  std::partial_sort(clusters.begin(), clusters.begin() + static_cast<std::ptrdiff_t>(count), clusters.end(),
                    [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
  clusters.resize(count);
  return clusters;
}

/// Works out the rows of the clusters nearest to the readings: what is below the `count` best of them, or far
/// below the best, does not matter. Nothing if they hold too few possible scenes.
std::optional<double> EvidenceScreen::least_that_matters(const Observation& observation,
                                                         std::size_t count) const {
  for (const std::size_t wanted : kClustersFirst) {
    const std::vector<std::size_t> rows = rows_of(nearest_clusters(observation, wanted));
    std::vector<double> values = log_evidence_of_each(observation, table_, rows);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += priors_.row[rows[i]];
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.size() >= count) return least_beside(std::move(values), count, eligible_.rows.size());
  }
  return std::nullopt;
}

std::vector<std::size_t> EvidenceScreen::rows_within_bounds(const Observation& observation,
                                                            std::size_t count) const {
  const double threshold = least_that_matters(observation, count).value_or(kImpossible);
  if (gaussian_screen_applies(observation))
    return in_order(gaussian_.rows_in_reach(observation, priors_, threshold));
  const std::vector<double> bounds = cluster_bounds(observation, index_);
  std::vector<std::size_t> clusters;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (bounds[i] + priors_.cluster[i] >= threshold && bounds[i] > kImpossible) clusters.push_back(i);
  return rows_of(clusters);
}

/// A few possible rows near the readings, in ascending order.
std::vector<std::size_t> EvidenceScreen::likely_rows(const Observation& observation,
                                                     std::span<const std::size_t> possible) const {
  std::vector<std::size_t> near = rows_of(nearest_clusters(observation, kLikelyClusters));
  near = possible_rows(observation, table_, near);
  if (near.size() < kLikelyRows) near.assign(possible.begin(), possible.end());
  std::vector<std::size_t> rows;
  for (const ScoredRow& found : exhaustive_search(observation.displacement, table_, near, kLikelyRows))
    rows.push_back(found.row);
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// Of the possible ones: no reading is at a block that they lack.
RowValues EvidenceScreen::in_order_of_estimates(const Observation& observation, std::size_t count) const {
  std::vector<std::size_t> rows = possible_rows(observation, table_, eligible_.rows);
  if (rows.empty()) return {kImpossible, {}, {}};
  const std::vector<double> log_silence = log_chance_of_silence(observation, table_, rows);
  std::vector<double> beforehand = log_silence;
  for (std::size_t i = 0; i < rows.size(); ++i) beforehand[i] += priors_.row[rows[i]];
  const std::vector<std::size_t> likely = likely_rows(observation, rows);
  std::vector<double> logs =
      evidence_that_matters(observation, table_, rows, beforehand, likely, count, kScreenedAway);
  for (std::size_t i = 0; i < rows.size(); ++i) logs[i] += log_silence[i];
  return {kImpossible, std::move(rows), std::move(logs)};
}

RowValues EvidenceScreen::operator()(const Observation& observation, std::size_t count) const {
  if (observation.count == 0 || eligible_.rows.empty())
    return log_evidence_of_rows(observation, table_, eligible_.rows);
  if (cluster_bounds_apply(observation) && index_.clusters() > 0)
    return log_evidence_of_rows(observation, table_, rows_within_bounds(observation, count));
  const bool over_levels = observation.unknown_level && !has_closed_form(observation);
  const bool takes_long = observation.softens_bounds() && !observation.unknown_level &&
                          shapes_of(observation.noise).front() == NoiseShape::uniform;
  if (over_levels || takes_long) return in_order_of_estimates(observation, count);
  return log_evidence_of_rows(observation, table_, possible_rows(observation, table_, eligible_.rows));
}

}  // namespace voussoir
