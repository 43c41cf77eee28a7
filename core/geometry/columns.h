#pragma once
/// @file Things by the upright columns of the plane that they reach into: who is near whom, without looking
/// at all.

#include <algorithm>
#include <cmath>
#include <vector>

namespace voussoir {

class Columns {
 public:
  /// Between x = `left` and `right` [m].
  Columns(double left, double right, std::size_t count)
      : left_(left), width_(std::max(right - left, 1e-9) / static_cast<double>(count)), items_(count) {}

  void add(int item, double left, double right) {
    for (std::size_t c = column(left); c <= column(right); ++c) items_[c].push_back(item);
  }

  /// Those that reach into a column between these two x; ascending, each once.
  std::vector<int> between(double left, double right) const {
    std::vector<int> found;
    for (std::size_t c = column(left); c <= column(right); ++c)
      found.insert(found.end(), items_[c].begin(), items_[c].end());
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  std::size_t column(double x) const {
    const double place = std::floor((x - left_) / width_);
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(items_.size() - 1)));
  }

  double left_, width_;
  std::vector<std::vector<int>> items_;
};

}  // namespace voussoir
