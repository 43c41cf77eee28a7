#pragma once
/// @file The middle one of some numbers.

#include <algorithm>
#include <vector>

namespace voussoir {

/// The upper one of the two in the middle of an even number. Precondition: there is a number.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace voussoir
