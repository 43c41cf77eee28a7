#include "database/search/index_building.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "database/search/row_clusters.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostRows = 64;      // of a cluster, before rows move to the nearest centre
constexpr std::size_t kMostFarRows = 256;  // of scenes that collapse: few readings come near them
constexpr double kFarthest = 1e9;          // what is beyond is alike
constexpr double kLeastMovement = 1e-4;    // [m] of points that hardly move, when rows are compared
constexpr int kFinestExponent = -21;       // half a micrometre; 16000 of it are 7.6 mm
constexpr int kExponentStep = 4;  // few different units, because readings are rounded to each of them
constexpr std::int32_t kLargestByte = 127;
constexpr std::int32_t kLargestDistance = 65535;  // of SlotBounds

/// A row's movements against the first row, in relation to the square root of what is usual: so noise that is
/// proportional to movement makes them count. Zero where it has none.
void append_movements(std::span<const double> row, std::span<const double> first, std::size_t places,
                      std::vector<float>& values) {
  const std::size_t old = values.size();
  values.resize(old + places, 0.0F);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double difference = row[i] - first[i];
    if (std::isfinite(difference))
      values[old + i] = static_cast<float>(
          std::clamp(difference / std::sqrt(std::abs(first[i]) + kLeastMovement), -kFarthest, kFarthest));
  }
}

/// What is known of a point over a cluster's rows [units].
struct PlaceRange {
  double least = 0.0, most = 0.0, sum = 0.0;
  std::size_t count = 0;

  void add(double value) {
    least = count == 0 ? value : std::min(least, value);
    most = count == 0 ? value : std::max(most, value);
    sum += value;
    ++count;
  }
  double middle() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
};

/// A row on its way into the index.
struct Sketch {
  std::int32_t row, distance, step, start;
  std::vector<std::int8_t> steps;  // of each place
};

/// Sums of whole places are far above what rounding takes from them.
std::int32_t rounded_up(double sum) {
  return static_cast<std::int32_t>(std::ceil(sum * (1.0 + 1e-12)));
}

class IndexBuilding {
 public:
  IndexBuilding(std::span<const double> rows, std::size_t points) : rows_(rows), points_(points) {
    index_.places = places_for(points);
  }

  SearchIndexData run() {
    std::map<int, std::vector<std::size_t>> by_exponent;
    for (std::size_t i = 0; i < rows_.size() / points_; ++i)
      if (has_displacements(row(i))) by_exponent[exponent_of(row(i))].push_back(i);
    index_.first.push_back(0);
    for (const auto& [exponent, members] : by_exponent) add_unit(exponent, members);
    return std::move(index_);
  }

 private:
  std::span<const double> row(std::size_t index) const { return rows_.subspan(index * points_, points_); }

  static bool has_displacements(std::span<const double> row) {
    return std::any_of(row.begin(), row.end(), [](double value) { return std::isfinite(value); });
  }

  /// The finest unit in which all displacements of the row are small enough.
  static int exponent_of(std::span<const double> row) {
    double largest = 0.0;
    for (const double value : row)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    int exponent = kFinestExponent;
    while (std::ldexp(largest, -exponent) > kFarthestPlace - 1) exponent += kExponentStep;
    return exponent;
  }

  void add_unit(int exponent, const std::vector<std::size_t>& members) {
    std::vector<float> values;
    for (const std::size_t member : members) append_movements(row(member), row(0), index_.places, values);
    const RowClusters clusters =
        cluster_rows(values, index_.places, exponent == kFinestExponent ? kMostRows : kMostFarRows);
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      std::vector<std::size_t> rows;
      for (const std::size_t place : clusters.rows(i)) rows.push_back(members[place]);
      add_cluster(exponent, rows);
    }
  }

  void add_cluster(int exponent, std::span<const std::size_t> members) {
    std::vector<PlaceRange> ranges(index_.places);
    for (const std::size_t member : members)
      for (std::size_t i = 0; i < points_; ++i)
        if (const double value = row(member)[i]; std::isfinite(value))
          ranges[i].add(std::ldexp(value, -exponent));
    index_.exponent.push_back(exponent);
    for (const PlaceRange& range : ranges) {
      index_.centre.push_back(static_cast<std::int16_t>(std::round(range.middle())));
      index_.least.push_back(static_cast<std::int16_t>(std::floor(range.least)));
      index_.most.push_back(static_cast<std::int16_t>(std::ceil(range.most)));
    }
    std::vector<Sketch> sketches;
    for (const std::size_t member : members) sketches.push_back(sketch_of(member));
    std::stable_sort(sketches.begin(), sketches.end(),
                     [](const Sketch& a, const Sketch& b) { return a.distance > b.distance; });
    int coarseness = 0;
    while (sketches.front().distance >> coarseness >= kLargestDistance) ++coarseness;
    index_.coarseness.push_back(coarseness);
    for (const Sketch& sketch : sketches) add(sketch, coarseness);
    index_.first.push_back(static_cast<std::int32_t>(index_.row.size()));
  }

  /// A row against the last cluster.
  Sketch sketch_of(std::size_t member) const {
    std::vector<double> difference(index_.places, 0.0);  // zero where the row has no displacement
    double distance = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < points_; ++i) {
      const double value = std::ldexp(row(member)[i], -index_.exponent.back());
      if (!std::isfinite(value)) continue;
      difference[i] = value - index_.centre[index_.centre.size() - index_.places + i];
      distance += std::abs(difference[i]);
      largest = std::max(largest, std::abs(difference[i]));
    }
    const double step = std::max(1.0, std::ceil(largest / kLargestByte));
    Sketch result{
        static_cast<std::int32_t>(member), rounded_up(distance), static_cast<std::int32_t>(step), 0, {}};
    double lost = 0.0;
    std::int32_t sum = 0;
    for (const double value : difference) {
      const double steps = std::round(value / step);
      result.steps.push_back(static_cast<std::int8_t>(steps));
      lost += std::abs(value - steps * step);
      sum += result.steps.back();
    }
    result.start = rounded_up(lost) - result.step * sum;
    return result;
  }

  void add(const Sketch& sketch, int coarseness) {
    const std::int32_t distance = (sketch.distance + (1 << coarseness) - 1) >> coarseness;
    index_.row.push_back(sketch.row);
    index_.bounds.push_back(
        {static_cast<std::uint32_t>(distance) | static_cast<std::uint32_t>(sketch.step) << 16U,
         sketch.start});
    index_.sketch.insert(index_.sketch.end(), sketch.steps.begin(), sketch.steps.end());
  }

  std::span<const double> rows_;
  std::size_t points_;
  SearchIndexData index_;
};

}  // namespace

SearchIndexData build_search_index(std::span<const double> rows, std::size_t points) {
  return IndexBuilding(rows, points).run();
}

}  // namespace voussoir
