#include "database/search/row_clusters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/simd/lanes.h"

namespace voussoir {
namespace {

constexpr std::size_t kSample = 256;  // rows from which two centres are found
constexpr int kHalvingRounds = 3;     // of moving the centres to the middle of their rows, here and below
constexpr int kRounds = 6;

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

class Clustering {
 public:
  Clustering(std::span<const float> values, std::size_t stride, std::size_t most)
      : values_(values), stride_(stride), most_(most), cluster_(values.size() / stride, 0) {}

  RowClusters run() {
    std::vector<std::size_t> all(cluster_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (!all.empty()) split(std::move(all));
    for (int round = 0; round < kRounds; ++round) {
      move_centres();
      assign();
    }
    return result();
  }

 private:
  const float* row(std::size_t index) const { return values_.data() + index * stride_; }
  const float* centre(std::size_t cluster) const { return centres_.data() + cluster * stride_; }

  std::vector<float> squares(const std::vector<std::size_t>& rows, const float* from) const {
    std::vector<const float*> pointers;
    for (const std::size_t index : rows) pointers.push_back(row(index));
    std::vector<float> result(rows.size());
    find_squares(pointers.data(), rows.size(), from, stride_, result.data());
    return result;
  }

  const float* farthest(const std::vector<std::size_t>& sample, const float* from) const {
    const std::vector<float> found = squares(sample, from);
    return row(
        sample[static_cast<std::size_t>(std::max_element(found.begin(), found.end()) - found.begin())]);
  }

  void split(std::vector<std::size_t> rows) {
    if (rows.size() > most_) {
      std::vector<std::size_t> other = halve(rows);
      if (!rows.empty() && !other.empty()) {
        split(std::move(rows));
        split(std::move(other));
        return;
      }
      rows.insert(rows.end(), other.begin(), other.end());
    }
    for (const std::size_t index : rows) cluster_[index] = clusters_;
    ++clusters_;
  }

  /// Takes the farther half out of `rows`.
  std::vector<std::size_t> halve(std::vector<std::size_t>& rows) const {
    std::vector<std::size_t> sample;
    const std::size_t step = (rows.size() + kSample - 1) / kSample;
    for (std::size_t i = 0; i < rows.size(); i += step) sample.push_back(rows[i]);
    const float* const first = farthest(sample, row(rows.front()));
    const float* const second = farthest(sample, first);
    std::vector<float> one(first, first + stride_), two(second, second + stride_);
    for (int round = 0; round < kHalvingRounds; ++round) move_to_middles(sample, one, two);
    const std::vector<float> to_one = squares(rows, one.data());
    const std::vector<float> to_two = squares(rows, two.data());
    std::vector<std::size_t> near, far;
    for (std::size_t i = 0; i < rows.size(); ++i) (to_one[i] < to_two[i] ? near : far).push_back(rows[i]);
    rows = std::move(near);
    return far;
  }

  void move_to_middles(const std::vector<std::size_t>& sample, std::vector<float>& one,
                       std::vector<float>& two) const {
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

  void move_centres() {
    centres_.assign(clusters_ * stride_, 0.0F);
    std::vector<float> count(clusters_, 0.0F);
    for (std::size_t index = 0; index < cluster_.size(); ++index) {
      ++count[cluster_[index]];
      for (std::size_t k = 0; k < stride_; ++k) centres_[cluster_[index] * stride_ + k] += row(index)[k];
    }
    for (std::size_t cluster = 0; cluster < clusters_; ++cluster)
      for (std::size_t k = 0; k < stride_; ++k)
        centres_[cluster * stride_ + k] /= std::max(count[cluster], 1.0F);
  }

  std::vector<std::vector<std::size_t>> members() const {
    std::vector<std::vector<std::size_t>> result(clusters_);
    for (std::size_t index = 0; index < cluster_.size(); ++index) result[cluster_[index]].push_back(index);
    return result;
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
      find_squares(&candidate, 1, row(index), stride_, &found);
      if (found < least) own = other.cluster;
      least = std::min(least, found);
    }
    return own;
  }

  /// Puts every row to its nearest centre.
  void assign() {
    const auto old = members();
    std::vector<const float*> centres;
    for (std::size_t cluster = 0; cluster < clusters_; ++cluster) centres.push_back(centre(cluster));
    for (std::size_t own = 0; own < clusters_; ++own) {
      const std::vector<Neighbour> others = neighbours(own, centres);
      const std::vector<float> from_own = squares(old[own], centre(own));
      for (std::size_t i = 0; i < old[own].size(); ++i)
        cluster_[old[own][i]] = nearest(old[own][i], own, from_own[i], others);
    }
  }

  RowClusters result() const {
    RowClusters result;
    for (const auto& rows : members()) {
      if (rows.empty()) continue;
      result.begin.push_back(result.order.size());
      result.order.insert(result.order.end(), rows.begin(), rows.end());
    }
    result.begin.push_back(result.order.size());
    return result;
  }

  std::span<const float> values_;
  std::size_t stride_;
  std::size_t most_;
  std::size_t clusters_ = 0;
  std::vector<std::size_t> cluster_;  // of each row
  std::vector<float> centres_;
};

}  // namespace

RowClusters cluster_rows(std::span<const float> values, std::size_t stride, std::size_t most) {
  return Clustering(values, stride, most).run();
}

}  // namespace voussoir
