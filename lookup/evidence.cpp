#include "lookup/evidence.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kEdge = 1e-9;  // errors may exceed a bound by this share of it: rounding
/// Parts of the integrand below exp(-kNegligible) of its peak are left out.
constexpr double kNegligible = 40.0;

/// log of the density at level exp(u), as -count u - a exp(-power u) + constant; the Gaussian has power 2 and
/// a = sum z^2 / 2, the Laplace power 1 and a = sqrt(2) sum |z|.
struct LevelCurve {
  double count;
  double a;
  double power;
  double constant;

  double at(double u) const { return constant - count * u - a * std::exp(-power * u); }
  double peak() const { return std::log(a * power / count) / power; }
};

LevelCurve level_curve(NoiseShape shape, const RowStatistics& statistics, std::size_t count) {
  const double constant = static_cast<double>(count) * log_density(shape, 0.0, 0.0) - statistics.sum_log_scale;
  if (shape == NoiseShape::laplace)
    return {static_cast<double>(count), std::numbers::sqrt2 * statistics.sum_absolute, 1.0, constant};
  return {static_cast<double>(count), 0.5 * statistics.sum_square, 2.0, constant};
}

double clamp_level(double level) {
  return std::clamp(level, kSmallestLevel, kLargestLevel);
}

/// How far from the peak, in u, the curve falls by kNegligible: at most this to the left, where it falls like
/// exp(u), and this to the right, where it falls linearly in the end.
double reach_left(const LevelCurve& curve) {
  return std::sqrt(2.0 * kNegligible / (curve.count * curve.power));
}
double reach_right(const LevelCurve& curve) {
  return reach_left(curve) + (kNegligible + 1.0) / curve.count;
}

double log_range() {
  return std::log(kLargestLevel / kSmallestLevel);
}

double integrate(const LevelCurve& curve) {
  const double first = std::log(kSmallestLevel);
  const double last = std::log(kLargestLevel);
  const double peak = std::clamp(curve.a > 0.0 ? curve.peak() : first, first, last);
  const double from = std::max(first, peak - reach_left(curve));
  const double to = std::min(last, peak + reach_right(curve));
  const double top = curve.at(peak);
  const auto density = [&](double u) { return std::exp(curve.at(u) - top); };
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const double left = from < peak ? Rule::integrate(density, from, peak) : 0.0;
  const double right = peak < to ? Rule::integrate(density, peak, to) : 0.0;
  return top + std::log(left + right);
}

double log_uniform_evidence(const RowStatistics& statistics, std::size_t count) {
  const double smallest = std::max(statistics.largest * (1.0 - kEdge), kSmallestLevel);
  if (smallest >= kLargestLevel) return kImpossible;
  const auto n = static_cast<double>(count);
  const double share_left = -std::expm1(-n * std::log(kLargestLevel / smallest));
  return -n * std::log(2.0 * smallest) + std::log(share_left / n) - statistics.sum_log_scale;
}

}  // namespace

double log_likelihood(NoiseShape shape, const RowStatistics& statistics, std::size_t count, double level) {
  if (std::isnan(statistics.sum_absolute)) return kImpossible;
  if (shape == NoiseShape::uniform) {
    if (statistics.largest > level * (1.0 + kEdge)) return kImpossible;
    return -static_cast<double>(count) * std::log(2.0 * level) - statistics.sum_log_scale;
  }
  return level_curve(shape, statistics, count).at(std::log(level));
}

double log_evidence(NoiseShape shape, const RowStatistics& statistics, std::size_t count) {
  if (std::isnan(statistics.sum_absolute)) return kImpossible;
  const double sum = shape == NoiseShape::uniform ? log_uniform_evidence(statistics, count)
                                                  : integrate(level_curve(shape, statistics, count));
  return sum - std::log(log_range());
}

double log_evidence_bound(NoiseShape shape, const RowStatistics& statistics, std::size_t count) {
  return log_likelihood(shape, statistics, count, likeliest_level(shape, statistics, count));
}

double likeliest_level(NoiseShape shape, const RowStatistics& statistics, std::size_t count) {
  if (shape == NoiseShape::uniform) return clamp_level(statistics.largest);
  const LevelCurve curve = level_curve(shape, statistics, count);
  return curve.a > 0.0 ? clamp_level(std::exp(curve.peak())) : kSmallestLevel;
}

double log_sum(double a, double b) {
  const double larger = std::max(a, b);
  return larger == kImpossible ? kImpossible : larger + std::log1p(std::exp(std::min(a, b) - larger));
}

}  // namespace voussoir
