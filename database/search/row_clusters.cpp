#include "database/search/row_clusters.h"

#include <algorithm>
#include <numeric>

#include "core/simd/lanes.h"
#include "core/threads.h"

namespace voussoir {
namespace {

constexpr std::size_t kSample = 256;  // rows from which two centres are found
constexpr int kHalvingRounds = 3;     // of moving the centres to the middle of their rows, here and below
constexpr int kRounds = 6;
constexpr std::size_t kTogether = 32768;  // rows at most: rounds take a time that grows with their square

/// Squared distances of many rows from one.
VOUSSOIR_FOR_EVERY_PROCESSOR
void find_squares(const float* const* rows, std::size_t count, const float* from, std::size_t stride,
                  float* squares) {
  for (std::size_t row = 0; row < count; ++row) {
    FloatLanes sum{};
    for (std::size_t i = 0; i < stride; i += kFloatLanes) {
      const FloatLanes apart = load<FloatLanes>(rows[row] + i) - load<FloatLanes>(from + i);
      sum += apart * apart;
    }
    squares[row] = sum_of(sum);
  }
}

/// Some rows by their places, ascending.
using Rows = std::vector<std::size_t>;

/// Rows of numbers and what halves sets of them.
class RowTable {
 public:
  RowTable(std::span<const float> values, std::size_t stride) : values_(values), stride_(stride) {}

  std::size_t stride() const { return stride_; }
  const float* row(std::size_t index) const { return values_.data() + index * stride_; }

  std::vector<float> squares(const Rows& rows, const float* from) const {
    std::vector<const float*> pointers;
    for (const std::size_t index : rows) pointers.push_back(row(index));
    std::vector<float> result(rows.size());
    find_squares(pointers.data(), rows.size(), from, stride_, result.data());
    return result;
  }

  /// Sets of at most so many rows that differ, which two centres take from each other again and again.
  std::vector<Rows> split(Rows rows, std::size_t most) const {
    std::vector<Rows> parts, left = {std::move(rows)};
    while (!left.empty()) {
      Rows near = std::move(left.back());
      left.pop_back();
      Rows far = near.size() > most ? halve(near) : Rows();
      if (!near.empty() && !far.empty()) {
        left.push_back(std::move(far));
        left.push_back(std::move(near));
      } else {
        parts.push_back(near.empty() ? std::move(far) : std::move(near));
      }
    }
    return parts;
  }

 private:
  const float* farthest(const Rows& sample, const float* from) const {
    const std::vector<float> found = squares(sample, from);
    return row(
        sample[static_cast<std::size_t>(std::max_element(found.begin(), found.end()) - found.begin())]);
  }

  /// Takes the farther half out of `rows`.
  Rows halve(Rows& rows) const {
    Rows sample;
    const std::size_t step = (rows.size() + kSample - 1) / kSample;
    for (std::size_t i = 0; i < rows.size(); i += step) sample.push_back(rows[i]);
    const float* const first = farthest(sample, row(rows.front()));
    const float* const second = farthest(sample, first);
    std::vector<float> one(first, first + stride_), two(second, second + stride_);
    for (int round = 0; round < kHalvingRounds; ++round) move_to_middles(sample, one, two);
    const std::vector<float> to_one = squares(rows, one.data());
    const std::vector<float> to_two = squares(rows, two.data());
    Rows near, far;
    for (std::size_t i = 0; i < rows.size(); ++i) (to_one[i] < to_two[i] ? near : far).push_back(rows[i]);
    rows = std::move(near);
    return far;
  }

  void move_to_middles(const Rows& sample, std::vector<float>& one, std::vector<float>& two) const {
    const std::vector<float> to_one = squares(sample, one.data());
    const std::vector<float> to_two = squares(sample, two.data());
    std::vector<float> sums[2] = {std::vector<float>(stride_, 0.0F), std::vector<float>(stride_, 0.0F)};
    float count[2] = {0.0F, 0.0F};
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const int side = to_one[i] < to_two[i] ? 0 : 1;
      ++count[side];
      for (std::size_t k = 0; k < stride_; ++k) sums[side][k] += row(sample[i])[k];
    }
    for (std::size_t k = 0; k < stride_; ++k) {
      one[k] = sums[0][k] / std::max(count[0], 1.0F);
      two[k] = sums[1][k] / std::max(count[1], 1.0F);
    }
  }

  std::span<const float> values_;
  std::size_t stride_;
};

/// A few rounds of k-means over some rows, from sets that halving found.
class Rounds {
 public:
  Rounds(const RowTable& table, std::vector<Rows> sets)
      : table_(table), stride_(table.stride()), members_(std::move(sets)), clusters_(members_.size()) {}

  std::vector<Rows> run() {
    for (int round = 0; round < kRounds; ++round) {
      move_centres();
      assign();
    }
    return std::move(members_);
  }

 private:
  const float* centre(std::size_t cluster) const { return centres_.data() + cluster * stride_; }

  void move_centres() {
    centres_.assign(clusters_ * stride_, 0.0F);
    for (std::size_t cluster = 0; cluster < clusters_; ++cluster) {
      float* const sums = centres_.data() + cluster * stride_;
      for (const std::size_t index : members_[cluster])
        for (std::size_t k = 0; k < stride_; ++k) sums[k] += table_.row(index)[k];
      const auto count = static_cast<float>(std::max(members_[cluster].size(), std::size_t{1}));
      for (std::size_t k = 0; k < stride_; ++k) sums[k] /= count;
    }
  }

  /// Another cluster's centre and its squared distance from this one's.
  struct Neighbour {
    float square;
    std::size_t cluster;
    friend bool operator<(const Neighbour& a, const Neighbour& b) {
      return a.square != b.square ? a.square < b.square : a.cluster < b.cluster;
    }
  };

  std::vector<Neighbour> neighbours(std::size_t own, const std::vector<const float*>& centres) const {
    std::vector<float> squares(clusters_);
    find_squares(centres.data(), clusters_, centre(own), stride_, squares.data());
    std::vector<Neighbour> result;
    for (std::size_t i = 0; i < clusters_; ++i) result.push_back({squares[i], i});
    std::sort(result.begin(), result.end());
    return result;
  }

  /// The centre nearest to a row of a cluster. A centre twice as far from the row's own as the row is cannot
  /// be nearer to it.
  std::size_t nearest(std::size_t index, std::size_t own, float square,
                      const std::vector<Neighbour>& neighbours) const {
    float least = square;
    for (const Neighbour& other : neighbours) {
      if (other.square >= 4.0F * square) break;
      const float* const candidate = centre(other.cluster);
      float found = 0.0F;
      find_squares(&candidate, 1, table_.row(index), stride_, &found);
      if (found < least) own = other.cluster;
      least = std::min(least, found);
    }
    return own;
  }

  /// Puts every row to its nearest centre.
  void assign() {
    std::vector<const float*> centres;
    for (std::size_t cluster = 0; cluster < clusters_; ++cluster) centres.push_back(centre(cluster));
    std::vector<Rows> moved(clusters_);
    for (std::size_t own = 0; own < clusters_; ++own) {
      const std::vector<Neighbour> others = neighbours(own, centres);
      const std::vector<float> from_own = table_.squares(members_[own], centre(own));
      for (std::size_t i = 0; i < members_[own].size(); ++i)
        moved[nearest(members_[own][i], own, from_own[i], others)].push_back(members_[own][i]);
    }
    for (Rows& rows : moved) std::sort(rows.begin(), rows.end());
    members_ = std::move(moved);
  }

  const RowTable& table_;
  std::size_t stride_;
  std::vector<Rows> members_;  // of each cluster
  std::size_t clusters_;
  std::vector<float> centres_;
};

}  // namespace

RowClusters cluster_rows(std::span<const float> values, std::size_t stride, std::size_t most) {
  const RowTable table(values, stride);
  Rows all(values.size() / stride);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<Rows> parts = table.split(std::move(all), kTogether);
  std::vector<std::vector<Rows>> clusters(parts.size());
  for_each_index_on_threads(parts.size(), hardware_threads(), [&](std::size_t i) {
    clusters[i] = Rounds(table, table.split(parts[i], most)).run();
  });
  RowClusters result;
  for (const std::vector<Rows>& of_part : clusters)
    for (const Rows& rows : of_part) {
      if (rows.empty()) continue;
      result.begin.push_back(result.order.size());
      result.order.insert(result.order.end(), rows.begin(), rows.end());
    }
  result.begin.push_back(result.order.size());
  return result;
}

}  // namespace voussoir
