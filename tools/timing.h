#pragma once
/// @file What is said of a repeated measurement.

#include <algorithm>
#include <string>
#include <vector>

namespace voussoir {

struct Timing {
  std::string name;
  double median = 0.0;  ///< [ms]
  double p95 = 0.0;     ///< [ms]
};

/// Median and 95th percentile of some times [ms], of which there must be one.
inline Timing timing_of(const std::string& name, std::vector<double> milliseconds) {
  std::sort(milliseconds.begin(), milliseconds.end());
  const auto at = [&](double share) {
    return milliseconds[static_cast<std::size_t>(share * static_cast<double>(milliseconds.size() - 1))];
  };
  return {name, at(0.5), at(0.95)};
}

}  // namespace voussoir
