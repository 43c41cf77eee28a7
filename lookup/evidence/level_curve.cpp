#include "lookup/evidence/level_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {

double LevelCurve::at(double u) const {
  return constant - count * u - a * std::exp(-power * u);
}

double LevelCurve::peak() const {
  return std::log(a * power / count) / power;
}

double LevelCurve::peak_between(double first, double last) const {
  return std::clamp(a > 0.0 ? peak() : first, first, last);
}

LevelCurve level_curve(NoiseShape shape, const RowStatistics& statistics, std::size_t count) {
  const double constant = static_cast<double>(count) * log_density(shape, 0.0, 0.0) -
                          statistics.sum_log_scale - 0.5 * statistics.scale_square;
  if (shape == NoiseShape::laplace)
    return {static_cast<double>(count), std::numbers::sqrt2 * statistics.sum_absolute, 1.0, constant};
  return {static_cast<double>(count), 0.5 * statistics.sum_square, 2.0, constant};
}

double log_range() {
  return std::log(kLargestLevel / kSmallestLevel);
}

}  // namespace voussoir
