#pragma once
/// @file How far the estimates of scenes of one kind are too high, as those show that were worked out last.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace voussoir {

class EstimateErrors {
 public:
  /// Of a scene that was worked out: logarithms.
  void add(double estimate, double exact) { errors_.push_back(exact - estimate); }

  /// log of what the sum of all other estimates is multiplied by at most, not above zero: of the last n, half
  /// of all, the least that one was too high by, and for 3 of n all of it. (If more than that share of the
  /// others were better estimated, one of the n would be with a chance of 95 %.) Nothing before there are
  /// sixteen.
  double most() const {
    if (errors_.size() < kFewest) return 0.0;
    const auto last = last_half();
    const double share = 3.0 / static_cast<double>(last.size());
    return std::min(0.0, std::log(std::exp(*std::max_element(last.begin(), last.end())) + share));
  }

  /// The same on average.
  double mean() const {
    if (errors_.empty()) return 0.0;
    double sum = 0.0;
    for (const double error : last_half()) sum += std::exp(error);
    return std::min(0.0, std::log(sum / static_cast<double>(last_half().size())));
  }

 private:
  static constexpr std::size_t kFewest = 16;

  std::span<const double> last_half() const {
    return std::span(errors_).last(std::min(errors_.size(), std::max(kFewest, errors_.size() / 2)));
  }

  std::vector<double> errors_;
};

}  // namespace voussoir
