#include "lookup/sketches.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

constexpr double kLargestByte = 127.0;     // steps above or below the centre
constexpr double kSinglePrecision = 1e-6;  // share of a distance that bounds may lose by it
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float above(double value) {
  return std::nextafter(static_cast<float>(value), kInfinity);
}

/// The mean of the rows, point by point, of those that have a displacement.
std::vector<double> middle(std::span<const double> rows, std::size_t points,
                           std::span<const std::size_t> members) {
  std::vector<double> sum(points, 0.0), count(points, 0.0);
  for (const std::size_t member : members)
    for (std::size_t i = 0; i < points; ++i) {
      const double value = rows[member * points + i];
      sum[i] += std::isnan(value) ? 0.0 : value;
      count[i] += std::isnan(value) ? 0.0 : 1.0;
    }
  for (std::size_t i = 0; i < points; ++i) sum[i] /= std::max(count[i], 1.0);
  return sum;
}

struct Member {
  std::size_t row;
  std::vector<double> difference;  // [m] from the centre, zero where the row has no displacement
  double distance = 0.0;           // [m]
};

Member member(std::span<const double> row, std::size_t index, std::span<const float> centre) {
  Member result{index, std::vector<double>(centre.size(), 0.0)};
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double difference = row[i] - static_cast<double>(centre[i]);
    if (std::isnan(difference)) continue;
    result.difference[i] = difference;
    result.distance += std::abs(difference);
  }
  return result;
}

}  // namespace

Sketches::Sketches(std::span<const double> rows, std::size_t points, const RowClusters& clusters)
    : stride_((points + kSketchPlaces - 1) / kSketchPlaces * kSketchPlaces) {
  for (std::size_t i = 0; i < clusters.size(); ++i) add_cluster(rows, points, clusters.rows(i));
  first_slot_.push_back(row_.size());
}

void Sketches::add_cluster(std::span<const double> rows, std::size_t points,
                           std::span<const std::size_t> members) {
  const std::vector<double> mean = middle(rows, points, members);
  centre_.insert(centre_.end(), mean.begin(), mean.end());
  centre_.resize((radius_.size() + 1) * stride_, 0.0F);
  std::vector<Member> sorted;
  for (const std::size_t index : members)
    sorted.push_back(member(rows.subspan(index * points, points), index, centre(radius_.size())));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Member& a, const Member& b) { return a.distance > b.distance; });
  first_slot_.push_back(row_.size());
  radius_.push_back(above(sorted.front().distance));
  for (const Member& one : sorted) add_sketch(one.row, one.difference, one.distance);
  while (row_.size() % kGroup != 0) {
    add_sketch(0, std::vector<double>(stride_, 0.0), 0.0);
    distance_.back() = -kInfinity;
    start_.back() = kInfinity;
  }
}

void Sketches::add_sketch(std::size_t row, std::span<const double> difference, double distance) {
  const std::size_t slot = row_.size();
  double largest = 0.0;
  for (const double value : difference) largest = std::max(largest, std::abs(value));
  const float step = above(largest / kLargestByte);
  double lost = kSinglePrecision * distance, sum = 0.0;
  sketch_.resize((slot / kGroup + 1) * kGroup * stride_, 0);
  for (std::size_t i = 0; i < stride_; ++i) {
    const double steps = std::round(difference[i] / static_cast<double>(step));
    sketch_[sketch_place(slot, i, stride_)] = static_cast<std::int8_t>(steps);
    lost += std::abs(difference[i] - steps * static_cast<double>(step));
    sum += steps;
  }
  row_.push_back(static_cast<std::uint32_t>(row));
  distance_.push_back(above(distance));
  step_.push_back(step);
  start_.push_back(-above(lost - sum * static_cast<double>(step)));
}

void Sketches::append_within(SketchReadings& readings, std::size_t cluster, float distance, float limit,
                             std::vector<RowBound>& found) const {
  const std::size_t first = first_slot_[cluster], slots = first_slot_[cluster + 1] - first;
  const std::size_t old = found.size();
  append_rows_within({sketch_.data() + first * stride_, std::span(step_).subspan(first, slots),
                      std::span(start_).subspan(first, slots), std::span(distance_).subspan(first, slots)},
                     readings, centre(cluster), distance, limit, found);
  for (std::size_t i = old; i < found.size(); ++i) found[i].row = row_[first + found[i].row];
}

void Sketches::expect(std::size_t cluster) const {
  const std::size_t slot = first_slot_[cluster];
  fetch(centre(cluster));
  fetch(std::span(sketch_).subspan(slot * stride_, kGroup * stride_ / 2));  // the rest follows by itself
  fetch(std::span(distance_).subspan(slot, 1));
}

std::size_t Sketches::bytes() const {
  return sketch_.size() + sizeof(float) * (centre_.size() + radius_.size() + 4 * step_.size()) +
         sizeof(std::size_t) * first_slot_.size();
}

}  // namespace voussoir
