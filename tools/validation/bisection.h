#pragma once
/// @file Limits by halving.

namespace voussoir::validation {

/// Largest x in [low, high] for which `holds`, within `width`, if it holds up to some x and not beyond.
/// Returns `low` if it holds nowhere that was tried, `high` (nearly) if everywhere.
template <typename Predicate>
double last_true(double low, double high, double width, Predicate holds) {
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace voussoir::validation
