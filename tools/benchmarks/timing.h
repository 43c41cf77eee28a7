#pragma once
/// @file Processor time, and what is said of repeated measurements.

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

namespace voussoir {

/// What this process has used of all processors so far.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

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
