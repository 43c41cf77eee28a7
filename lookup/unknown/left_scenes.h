#pragma once
/// @file Scenes that are only estimated so far, in the order of their estimates, and what they sum up to.
///
/// Estimates are too high, and those of scenes of one kind alike: those of a kind that were worked out say
/// how much less the others of that kind count.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "lookup/evidence/descending_places.h"
#include "lookup/unknown/estimate_errors.h"

namespace voussoir {

/// A logarithm of the scene at a place in a list.
struct PlaceLog {
  std::size_t place;
  double log;
};

class LeftScenes {
 public:
  static constexpr std::size_t kKinds = 5;
  static constexpr std::size_t kOther = kKinds - 1;  ///< of these nothing is learned: they are too different
  using KindOf = std::function<std::size_t(std::size_t place)>;

  /// Places of logarithms, which outlive this. The kind of a place is below kKinds.
  LeftScenes(std::vector<std::size_t> places, std::span<const double> estimates, KindOf kind_of);

  bool empty() const { return places_.empty(); }
  std::span<const std::size_t> places() const { return places_.rest(); }

  /// Takes so many away, if there are, the likeliest first.
  std::vector<std::size_t> next(std::size_t count);

  /// To be called when estimates of places that are left have changed.
  void order_again();

  /// Of a place that was taken away: its logarithm.
  void learn(std::size_t place, double exact);

  /// log of the sum of all that are left, at most, unless scenes are unlike those of their kind before them.
  double log_sum() const;

  /// All that are left, in no order, with what makes their estimates right on average.
  std::vector<PlaceLog> corrected() const;

 private:
  void add_up();

  std::span<const double> estimates_;
  KindOf kind_of_;
  DescendingPlaces places_;
  double unit_ = 0.0;                    // logarithm of what sums are in shares of
  std::array<double, kKinds> sums_{};    // of what is left
  std::array<double, kKinds> summed_{};  // what it was when it was added up
  std::array<EstimateErrors, kKinds> errors_;
};

}  // namespace voussoir
