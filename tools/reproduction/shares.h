#pragma once
/// @file Shares of trials.

#include <algorithm>

namespace voussoir {

inline constexpr double kPerCent = 100.0;  ///< in the whole

/// The part of the trials that are counted; 0 if there was no trial.
inline double share(int count, int trials) {
  return static_cast<double>(count) / std::max(1, trials);
}

}  // namespace voussoir
