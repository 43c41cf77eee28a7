#pragma once
/// @file Limits: by halving, and of sequences.

#include <cstddef>
#include <vector>

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

/// Smallest x for which `holds`, the same the other way round.
template <typename Predicate>
double first_true(double low, double high, double width, Predicate holds) {
  return -last_true(-high, -low, width, [&](double x) { return holds(-x); });
}

/// Value at x = 0 of the polynomial through the last `count` points (Neville's scheme).
inline double extrapolated(const std::vector<double>& x, const std::vector<double>& y, std::size_t count) {
  const std::size_t first = x.size() - count;
  std::vector<double> p(y.begin() + static_cast<std::ptrdiff_t>(first), y.end());
  for (std::size_t order = 1; order < count; ++order)
    for (std::size_t i = 0; i + order < count; ++i) {
      const double left = x[first + i];
      const double right = x[first + i + order];
      p[i] = (left * p[i + 1] - right * p[i]) / (left - right);
    }
  return p.front();
}

}  // namespace voussoir::validation
