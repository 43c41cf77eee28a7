#include "lookup/evidence/scene_evidence.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "lookup/evidence/level_curve.h"

namespace voussoir {
namespace {

/// Parts of the integrand below exp(-kFarBelow) of its peak are left out.
constexpr double kFarBelow = 40.0;

/// How far from the peak, in u, the curve falls by kFarBelow: at most this to the left, where it falls like
/// exp(u), and this to the right, where it falls linearly in the end.
double reach_left(const LevelCurve& curve) {
  return std::sqrt(2.0 * kFarBelow / (curve.count * curve.power));
}
double reach_right(const LevelCurve& curve) {
  return reach_left(curve) + (kFarBelow + 1.0) / curve.count;
}

double log_integral(const LevelCurve& curve) {
  const double first = std::log(kSmallestLevel);
  const double last = std::log(kLargestLevel);
  const double peak = curve.peak_between(first, last);
  const double from = std::max(first, peak - reach_left(curve));
  const double to = std::min(last, peak + reach_right(curve));
  const double top = curve.at(peak);
  const auto density = [&](double u) { return std::exp(curve.at(u) - top); };
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const double left = from < peak ? Rule::integrate(density, from, peak) : 0.0;
  const double right = peak < to ? Rule::integrate(density, peak, to) : 0.0;
  return top + std::log(left + right);
}

double log_uniform_integral(const RowStatistics& statistics, std::size_t count) {
  const double smallest = std::max(statistics.largest * (1.0 - kBoundTolerance), kSmallestLevel);
  if (smallest >= kLargestLevel) return kImpossible;
  const auto n = static_cast<double>(count);
  const double share_left = -std::expm1(-n * std::log(kLargestLevel / smallest));
  return -n * std::log(2.0 * smallest) + std::log(share_left / n) - statistics.sum_log_scale;
}

}  // namespace

double log_likelihood(NoiseShape shape, const RowStatistics& statistics, std::size_t count, double level) {
  if (std::isnan(statistics.sum_absolute)) return kImpossible;
  if (shape != NoiseShape::uniform) return level_curve(shape, statistics, count).at(std::log(level));
  if (statistics.largest > level * (1.0 + kBoundTolerance)) return kImpossible;
  return log_within_bound(statistics, count, level);
}

double log_within_bound(const RowStatistics& statistics, std::size_t count, double level) {
  return -static_cast<double>(count) * std::log(2.0 * level) - statistics.sum_log_scale -
         0.5 * statistics.scale_square;
}

double student_log_likelihood(const RowStatistics& statistics, std::size_t count, double degrees_of_freedom) {
  return static_cast<double>(count) * log_density(NoiseShape::student, 0.0, degrees_of_freedom) -
         statistics.sum_log_scale - 0.5 * (degrees_of_freedom + 1.0) * statistics.sum_log_student -
         0.5 * statistics.scale_square;
}

double log_evidence(NoiseShape shape, const RowStatistics& statistics, std::size_t count) {
  if (std::isnan(statistics.sum_absolute)) return kImpossible;
  const double integral = shape == NoiseShape::uniform ? log_uniform_integral(statistics, count)
                                                       : log_integral(level_curve(shape, statistics, count));
  return integral - std::log(log_range());
}

double likeliest_level(NoiseShape shape, const RowStatistics& statistics, std::size_t count,
                       double taken_at) {
  const double least = kSmallestLevel / taken_at;
  const double most = kLargestLevel / taken_at;
  if (shape == NoiseShape::uniform) return std::clamp(statistics.largest, least, most);
  return std::exp(level_curve(shape, statistics, count).peak_between(std::log(least), std::log(most)));
}

double log_sum(double a, double b) {
  const double larger = std::max(a, b);
  return std::isinf(larger) ? larger : larger + std::log1p(std::exp(std::min(a, b) - larger));
}

}  // namespace voussoir
