#pragma once
/// @file Places of values one after the other, the largest first, where few of many are needed.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace voussoir {

/// Equal values come in the order of places. The values outlive this; none is NaN.
class DescendingPlaces {
 public:
  DescendingPlaces(std::vector<std::size_t> places, std::span<const double> values)
      : heap_(std::move(places)), comes_later_{values} {
    std::make_heap(heap_.begin(), heap_.end(), comes_later_);
  }

  bool empty() const { return heap_.empty(); }
  std::size_t first() const { return heap_.front(); }
  std::span<const std::size_t> rest() const { return heap_; }  ///< in no order

  std::size_t next() {
    std::pop_heap(heap_.begin(), heap_.end(), comes_later_);
    const std::size_t place = heap_.back();
    heap_.pop_back();
    return place;
  }

 private:
  struct ComesLater {
    std::span<const double> values;
    bool operator()(std::size_t a, std::size_t b) const {
      return values[a] != values[b] ? values[a] < values[b] : a > b;
    }
  };

  std::vector<std::size_t> heap_;
  ComesLater comes_later_;
};

}  // namespace voussoir
