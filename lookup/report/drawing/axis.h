#pragma once
/// @file Axes of charts: from values to places, with round numbers to write beside them.

#include <span>
#include <string>
#include <vector>

namespace voussoir {

enum class AxisScale { linear, logarithmic };

struct Tick {
  double value = 0.0;
  std::string text;
};

/// Values from `lowest` to `highest` laid over the places from `begin` to `end` (which may be smaller).
struct AxisMap {
  double lowest = 0.0;
  double highest = 1.0;
  double begin = 0.0;
  double end = 1.0;
  AxisScale scale = AxisScale::linear;

  double operator()(double value) const;
};

/// The largest of 1, 2, 5 times a power of ten that is at most this. Precondition: it is positive.
double round_below(double value);

/// The range of some finite values, widened to round numbers (a logarithmic one to powers of ten, leaving out
/// values that are not positive), as an axis of about `ticks` steps.
AxisMap axis_over(std::span<const double> values, AxisScale scale, int ticks, double begin, double end);

/// Round numbers within the axis: about `count` of them, or the powers of ten.
std::vector<Tick> ticks_of(const AxisMap& axis, int count);

}  // namespace voussoir
