#include "lookup/search/indexed_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/fetch.h"
#include "core/parts.h"
#include "lookup/search/exhaustive_search.h"
#include "lookup/search/misfit.h"

namespace voussoir {
namespace {

constexpr std::size_t kNearest = 4;    // clusters first looked at
constexpr std::size_t kRowsAhead = 6;  // rows that are fetched while others are scored
constexpr std::size_t kClustersAhead = 4;
constexpr std::size_t kRowsExpected = 4;  // of a cluster: fetched while others are looked at
constexpr double kWorthwhile = 0.25;      // share of rows left beyond which scoring all of them is faster
constexpr std::size_t kFewRows = 512;     // that are scored without further ado
// Clusters whose centres are compared, or which are looked at, by one thread at a time: what takes as long as
// to wake another one, or longer.
constexpr std::size_t kCentresOfAThread = 4096, kClustersOfAThread = 512;
constexpr std::int32_t kAnything = 1 << 28;  // [units] limit without a limit
constexpr std::int32_t kDone = 1 << 29;      // [units] distance of clusters that need not be looked at again
constexpr std::uint32_t kNoBlock = 0, kNotEligible = 1, kFirstBlock = 2;

/// Keeps the smallest numbers seen.
class Smallest {
 public:
  explicit Smallest(std::size_t count) : count_(count) {}

  void add(double value) {
    if (value >= largest()) return;
    if (heap_.size() == count_) {
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back(value);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// Of the smallest `count`; infinite if there are not so many.
  double largest() const {
    return heap_.size() < count_ ? std::numeric_limits<double>::infinity() : heap_.front();
  }
  std::span<const double> values() const { return heap_; }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_;
  std::vector<double> heap_;
};

/// A limit [m] in units, rounded up by more than what sums lose in double precision.
std::int32_t in_units(double limit, double unit) {
  return static_cast<std::int32_t>(std::min(limit * (1.0 + 1e-12) / unit + 1.0, double{kAnything}));
}

/// A row that may be among the best, and what its sum [m] is at least.
struct Found {
  std::uint32_t slot;
  double least;
};

}  // namespace

/// What is asked of all clusters.
struct IndexedSearch::Query {
  std::span<const double> exact;
  std::vector<UnitReadings> readings{};    // of each unit
  std::vector<std::uint8_t> impossible{};  // of each block (from kFirstBlock on): a reading was taken on it
  std::vector<std::int32_t> distances{};   // of each cluster's centre [units], at least
};

/// What was found in some of the clusters.
struct IndexedSearch::Finds {
  Smallest smallest;  // of what the sums of rows are at most [m]
  RowBounds bounds;
  double limit =
      std::numeric_limits<double>::infinity();  // [m]: no row whose sum is above it is among the best
  std::vector<std::int32_t> limits{};           // the same for each unit [units]
  std::vector<Found> found{};

  void add(const Finds& others) {
    for (const double most : others.smallest.values()) smallest.add(most);
    found.insert(found.end(), others.found.begin(), others.found.end());
  }
};

IndexedSearch::IndexedSearch(const SceneTable& table, const SearchIndex& index,
                             const std::vector<StoredPoint>& points, const Eligible& eligible)
    : table_(table),
      index_(index),
      eligible_(eligible),
      most_rows_(largest_cluster(index)),
      units_(clusters_by_unit(index)) {
  for (const StoredPoint& point : points)
    point_blocks_.push_back({static_cast<std::size_t>(value(point.block)),
                             static_cast<std::size_t>(value(point.other_block.value_or(point.block)))});
  for (const auto& [block, other] : point_blocks_) blocks_ = std::max({blocks_, block + 1, other + 1});
  for (const std::int32_t block : table.removed)
    blocks_ = std::max(blocks_, static_cast<std::size_t>(block + 1));
  std::vector<bool> is_eligible(table.rows, false);
  for (const std::size_t row : eligible.rows) is_eligible[row] = true;
  for (const std::int32_t row : index.row)
    for (std::size_t i = 0; i < table.most_missing; ++i) {
      const std::int32_t block = table.removed[static_cast<std::size_t>(row) * table.most_missing + i];
      missing_.push_back(!is_eligible[static_cast<std::size_t>(row)] ? kNotEligible
                         : block < 0                                 ? kNoBlock
                                     : static_cast<std::uint32_t>(block) + kFirstBlock);
    }
  for (std::size_t unit = 0; unit < units_.size(); ++unit)
    unit_.resize(units_[unit].last, static_cast<std::uint32_t>(unit));
  for (std::size_t cluster = 0; cluster < index.clusters(); ++cluster)
    reach_.push_back(index.bounds[index.slot(cluster)].distance() << index.coarseness[cluster]);
}

/// Scenes that lack a block with a reading are impossible.
void IndexedSearch::sort_out_blocks(Query& query) const {
  query.impossible.assign(blocks_ + kFirstBlock, 0);
  query.impossible[kNotEligible] = 1;
  for (std::size_t i = 0; i < point_blocks_.size(); ++i)
    if (!std::isnan(query.exact[i]))
      for (const std::size_t block : point_blocks_[i]) query.impossible[block + kFirstBlock] = 1;
}

void IndexedSearch::find_distances(Query& query) const {
  query.distances.resize(index_.clusters());
  for (const UnitClusters& unit : units_) {
    query.readings.push_back(round_readings(query.exact, index_.places, unit.exponent));
    for_parts(unit.last - unit.first, kCentresOfAThread,
              [&](std::size_t, std::size_t first, std::size_t count) {
                first += unit.first;
                least_distances(query.readings.back(),
                                index_.centre.subspan(first * index_.places, count * index_.places),
                                std::span(query.distances).subspan(first, count));
              });
  }
}

/// Clusters whose centres are nearest to the readings.
std::vector<std::size_t> IndexedSearch::nearest_clusters(const Query& query) const {
  std::array<double, kNearest> distance;
  std::array<std::size_t, kNearest> nearest{};
  distance.fill(std::numeric_limits<double>::infinity());
  for (const UnitClusters& unit : units_) {
    std::int32_t worst = in_units(distance.back(), unit.metres);
    for (std::size_t cluster = unit.first; cluster < unit.last; ++cluster) {
      if (query.distances[cluster] >= worst) continue;
      const double found = unit.metres * query.distances[cluster];
      std::size_t place = kNearest - 1;
      for (; place > 0 && found < distance[place - 1]; --place) {
        distance[place] = distance[place - 1];
        nearest[place] = nearest[place - 1];
      }
      distance[place] = found;
      nearest[place] = cluster;
      worst = in_units(distance.back(), unit.metres);
    }
  }
  const auto known =
      std::count_if(distance.begin(), distance.end(), [](double one) { return std::isfinite(one); });
  return {nearest.begin(), nearest.begin() + known};
}

/// Clusters that may hold rows within the limits.
std::vector<std::size_t> IndexedSearch::clusters_in_reach(const Query& query,
                                                          const std::vector<std::int32_t>& limits) const {
  std::vector<std::size_t> result(index_.clusters() + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < units_.size(); ++i)
    for (std::size_t cluster = units_[i].first; cluster < units_[i].last; ++cluster) {
      result[count] = cluster;
      count += reach_[cluster] >= query.distances[cluster] - limits[i] ? 1 : 0;
    }
  result.resize(count);
  return result;
}

void IndexedSearch::set_limits(double limit, Finds& finds) const {
  finds.limit = limit;
  finds.limits.resize(units_.size());
  for (std::size_t i = 0; i < units_.size(); ++i) finds.limits[i] = in_units(limit, units_[i].metres);
}

bool IndexedSearch::is_possible(std::size_t slot, const Query& query) const {
  const auto missing = std::span(missing_).subspan(slot * table_.most_missing, table_.most_missing);
  return std::none_of(missing.begin(), missing.end(),
                      [&](std::uint32_t block) { return query.impossible[block] != 0; });
}

/// Finds those rows of a cluster that may be among the best.
void IndexedSearch::look_at(std::size_t cluster, const Query& query, Finds& finds) const {
  const std::size_t unit = unit_[cluster];
  const double metres = units_[unit].metres;
  for (const RowBound& one :
       finds.bounds.within(cluster, query.readings[unit], query.distances[cluster], finds.limits[unit])) {
    if (!is_possible(one.slot, query)) continue;
    finds.found.push_back({one.slot, metres * one.least});
    if (one.most < kUnbounded) finds.smallest.add(metres * one.most);
  }
  if (finds.smallest.largest() < finds.limit) set_limits(finds.smallest.largest(), finds);
}

void IndexedSearch::look_at(std::span<const std::size_t> clusters, const Query& query, Finds& finds) const {
  const auto expect = [&](std::size_t cluster) {
    const std::size_t slot = index_.slot(cluster), rows = std::min(kRowsExpected, index_.rows(cluster));
    fetch(index_.bounds.subspan(slot, rows));
    fetch(index_.sketch.subspan(slot * index_.places, rows * index_.places));  // the rest follows by itself
  };
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (i + kClustersAhead < clusters.size()) expect(clusters[i + kClustersAhead]);
    look_at(clusters[i], query, finds);
  }
}

/// The same, on all threads if there are many. Each begins with what is known of the limits.
void IndexedSearch::look_at_all(std::span<const std::size_t> clusters, const Query& query,
                                Finds& finds) const {
  if (clusters.size() <= kClustersOfAThread) return look_at(clusters, query, finds);
  Finds nothing{Smallest(finds.smallest.count()), finds.bounds, finds.limit, finds.limits};
  std::vector<Finds> parts(parts_of(clusters.size(), kClustersOfAThread), nothing);
  for_parts(clusters.size(), kClustersOfAThread, [&](std::size_t part, std::size_t first, std::size_t count) {
    look_at(clusters.subspan(first, count), query, parts[part]);
  });
  for (const Finds& part : parts) finds.add(part);
}

std::vector<ScoredRow> IndexedSearch::score(const Query& query, const Finds& finds) const {
  const auto row = [&](std::size_t i) { return static_cast<std::size_t>(index_.row[finds.found[i].slot]); };
  std::vector<ScoredRow> scored;
  scored.reserve(finds.found.size());
  for (std::size_t i = 0; i < std::min(kRowsAhead, finds.found.size()); ++i) fetch(table_.row(row(i)));
  for (std::size_t i = 0; i < finds.found.size(); ++i) {
    if (i + kRowsAhead < finds.found.size()) fetch(table_.row(row(i + kRowsAhead)));
    scored.push_back({row(i), sum_of_differences(query.exact, table_.row(row(i)))});
  }
  return scored;
}

IndexedSearch::Result IndexedSearch::search(std::span<const double> readings, std::size_t count) const {
  if (count == 0) return {};
  const auto score_all = [&] {
    return Result{exhaustive_search(readings, table_, eligible_.rows, count), eligible_.rows.size()};
  };
  if (eligible_.rows.size() <= kFewRows) return score_all();
  Query query{readings};
  sort_out_blocks(query);
  find_distances(query);
  Finds finds{Smallest(count), RowBounds(index_, most_rows_)};
  finds.found.reserve(kFewRows);
  set_limits(finds.limit, finds);
  for (const std::size_t cluster : nearest_clusters(query)) {
    look_at(cluster, query, finds);
    query.distances[cluster] = kDone;
  }
  look_at_all(clusters_in_reach(query, finds.limits), query, finds);
  std::erase_if(finds.found, [&](const Found& one) { return one.least > finds.smallest.largest(); });
  if (static_cast<double>(finds.found.size()) > kWorthwhile * static_cast<double>(eligible_.rows.size()))
    return score_all();
  return {best_rows(score(query, finds), count), finds.found.size()};
}

}  // namespace voussoir
