#include "lookup/sketch_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lookup/exhaustive_search.h"
#include "lookup/misfit.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostRows = 96;    // of a cluster, before rows move to the nearest centre
constexpr double kLeastMovement = 1e-4;  // [m] of points that hardly move, when rows are compared
constexpr std::size_t kNearest = 8;      // clusters first looked at
constexpr std::size_t kProbes = 2;       // rows scored first, for each one wanted
constexpr std::size_t kRowsAhead = 6;    // rows that are fetched while others are scored
constexpr std::size_t kClustersAhead = 2;
constexpr double kWorthwhile = 0.25;  // share of rows left beyond which scoring all of them is faster
constexpr double kFarthest = 1e6;     // [m] readings beyond it are not for single precision
constexpr float kAnything = std::numeric_limits<float>::max();

/// The displacements of some rows, one after the other.
std::vector<double> gather(const SceneTable& table, std::span<const std::size_t> rows) {
  std::vector<double> values;
  for (const std::size_t row : rows)
    values.insert(values.end(), table.row(row).begin(), table.row(row).end());
  return values;
}

/// Clusters of rows by their movements against the intact bridge, in relation to the square root of what is
/// usual: so noise that is proportional to movement makes them count.
RowClusters alike(std::span<const double> rows, std::span<const double> intact, std::size_t most) {
  const std::size_t stride = (intact.size() + kSketchPlaces - 1) / kSketchPlaces * kSketchPlaces;
  std::vector<float> values(rows.size() / intact.size() * stride, 0.0F);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t point = i % intact.size();
    if (!std::isnan(rows[i]))
      values[i / intact.size() * stride + point] =
          static_cast<float>((rows[i] - intact[point]) / std::sqrt(std::abs(intact[point]) + kLeastMovement));
  }
  return cluster_rows(values, stride, most);
}

Sketches sketches_of(std::span<const double> rows, std::span<const double> intact) {
  return {rows, intact.size(), alike(rows, intact, kMostRows)};
}

bool lower(const RowBound& a, const RowBound& b) {
  return a.bound < b.bound;
}

/// Keeps the smallest sums seen.
class BestSums {
 public:
  explicit BestSums(std::size_t count) : count_(count) {}

  void add(double sum) {
    heap_.push_back(sum);
    std::push_heap(heap_.begin(), heap_.end());
    if (heap_.size() <= count_) return;
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
  }

  /// Sums above it cannot be among the best `count`.
  double limit() const {
    return heap_.size() < count_ ? std::numeric_limits<double>::infinity() : heap_.front();
  }

 private:
  std::size_t count_;
  std::vector<double> heap_;
};

}  // namespace

/// One search on its way.
struct SketchIndex::Query {
  std::span<const double> exact;
  SketchReadings readings;
  BestSums best;
  std::vector<std::uint64_t> lacking;  // of each pattern
  std::vector<float> distances;        // [m] of each cluster's centre
  std::vector<RowBound> found{};       // rows that may be among the best
  std::vector<RowBound> within{};      // of one cluster
  std::vector<ScoredRow> scored{};

  bool matters(std::size_t i) const {
    return i < found.size() && static_cast<double>(found[i].bound) <= best.limit();
  }
  float limit() const {
    const auto rounded = static_cast<float>(best.limit());
    return std::isfinite(rounded) ? std::nextafter(rounded, kAnything) : kAnything;
  }
};

SketchIndex::SketchIndex(const SceneTable& table, std::span<const std::size_t> rows,
                         std::span<const double> intact)
    : table_(table),
      rows_(rows.begin(), rows.end()),
      patterns_(gather(table, rows), table.points),
      sketches_(sketches_of(gather(table, rows), intact)) {}

/// Clusters whose centres are nearest to the readings.
std::vector<RowBound> SketchIndex::nearest_clusters(const Query& query) const {
  std::vector<RowBound> nearest(std::min(kNearest, query.distances.size()), {0, kAnything});
  for (std::size_t i = 0; i < query.distances.size(); ++i) {
    if (query.distances[i] >= nearest.back().bound) continue;
    nearest.back() = {static_cast<std::uint32_t>(i), query.distances[i]};
    for (std::size_t place = nearest.size() - 1; place > 0 && lower(nearest[place], nearest[place - 1]);
         --place)
      std::swap(nearest[place], nearest[place - 1]);
  }
  return nearest;
}

/// Finds the rows of a cluster whose sums may be within the limit.
void SketchIndex::look_at(std::size_t cluster, float limit, Query& query) const {
  query.within.clear();
  sketches_.append_within(query.readings, cluster, query.distances[cluster], limit, query.within);
  for (const RowBound& one : query.within)
    if (query.lacking[patterns_.of(one.row)] == 0) query.found.push_back(one);
}

void SketchIndex::score(const RowBound& one, Query& query) const {
  query.scored.push_back({rows_[one.row], sum_of_differences(query.exact, row(one))});
  query.best.add(query.scored.back().sum);
}

/// Scores rows of the nearest clusters, so that there is a limit; gives how many of those found.
std::size_t SketchIndex::probe(const std::vector<RowBound>& nearest, std::size_t count, Query& query) const {
  for (const RowBound& cluster : nearest) look_at(cluster.row, kAnything, query);
  auto& found = query.found;
  const std::size_t probes = std::min(found.size(), kProbes * count);
  std::nth_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(probes), found.end(), lower);
  for (std::size_t i = 0; i < probes; ++i) fetch(row(found[i]));
  for (std::size_t i = 0; i < probes; ++i) score(found[i], query);
  return probes;
}

/// Looks at all other clusters that may hold rows within the limit.
void SketchIndex::look_at_others(const std::vector<RowBound>& nearest, Query& query) const {
  const float limit = query.limit();
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < query.distances.size(); ++i)
    if (sketches_.may_hold(i, query.readings, query.distances[i], limit)) others.push_back(i);
  std::erase_if(others, [&](std::size_t cluster) {
    return std::any_of(nearest.begin(), nearest.end(),
                       [&](const RowBound& one) { return one.row == cluster; });
  });
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (i + kClustersAhead < others.size()) sketches_.expect(others[i + kClustersAhead]);
    look_at(others[i], limit, query);
  }
}

SketchIndex::Result SketchIndex::search(std::span<const double> readings, std::size_t count) const {
  if (count == 0) return {};
  const auto score_all = [&] {
    return Result{exhaustive_search(readings, table_, rows_, count), rows_.size(), true};
  };
  if (std::any_of(readings.begin(), readings.end(), [](double value) { return std::abs(value) > kFarthest; }))
    return score_all();
  const SketchReadings prepared(readings);
  Query query{readings, prepared, BestSums(count), patterns_.lacking(readings),
              prepared.distances(sketches_.centres())};
  const std::vector<RowBound> nearest = nearest_clusters(query);
  const std::size_t probes = probe(nearest, count, query);
  look_at_others(nearest, query);
  const auto most = static_cast<std::size_t>(kWorthwhile * static_cast<double>(rows_.size()));
  for (std::size_t i = probes; i < query.found.size(); ++i) {
    if (query.matters(i + kRowsAhead)) fetch(row(query.found[i + kRowsAhead]));
    if (query.matters(i)) score(query.found[i], query);
    if (query.scored.size() > most) return score_all();
  }
  const std::size_t scored = query.scored.size();
  return {best_rows(std::move(query.scored), count), scored, false};
}

}  // namespace voussoir
