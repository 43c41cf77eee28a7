#include "lookup/report/drawing/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

constexpr double kStepRounding = 1e-9;  // of a step

/// The smallest of 1, 2, 5 times a power of ten that covers the range in at most `count` steps.
double round_step(double range, int count) {
  const double raw = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1.0 - kStepRounding)) return factor * power;
  return 10.0 * power;
}

/// A power of ten: plain where that is short, else as 10 with its exponent raised.
std::string power_of_ten(int exponent) {
  constexpr int kShortest = -3, kLongest = 4;
  if (exponent >= kShortest && exponent <= kLongest) return fmt::format("{:g}", std::pow(10.0, exponent));
  constexpr std::array<const char*, 10> kRaised = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                   "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "10\u207b" : "10";
  for (const char digit : fmt::format("{}", std::abs(exponent)))
    text += kRaised.at(static_cast<std::size_t>(digit - '0'));
  return text;
}

struct Range {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
};

Range range_of(std::span<const double> values, AxisScale scale) {
  Range range;
  for (const double value : values) {
    if (!std::isfinite(value) || (scale == AxisScale::logarithmic && value <= 0.0)) continue;
    range.lowest = std::min(range.lowest, value);
    range.highest = std::max(range.highest, value);
  }
  if (range.lowest <= range.highest) return range;
  return scale == AxisScale::linear ? Range{0.0, 1.0} : Range{1.0, 10.0};
}

AxisMap whole_decades(const Range& range, double begin, double end) {
  const double low = std::floor(std::log10(range.lowest) + kStepRounding);
  const double high = std::max(low + 1.0, std::ceil(std::log10(range.highest) - kStepRounding));
  return {std::pow(10.0, low), std::pow(10.0, high), begin, end, AxisScale::logarithmic};
}

}  // namespace

double round_below(double value) {
  const double most = value * (1.0 + kStepRounding);
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * (most >= 5.0 * power ? 5.0 : most >= 2.0 * power ? 2.0 : 1.0);
}

double AxisMap::operator()(double value) const {
  const bool logarithmic = scale == AxisScale::logarithmic;
  const double part = logarithmic ? std::log(value / lowest) / std::log(highest / lowest)
                                  : (value - lowest) / (highest - lowest);
  return begin + (end - begin) * part;
}

AxisMap axis_over(std::span<const double> values, AxisScale scale, int ticks, double begin, double end) {
  Range range = range_of(values, scale);
  if (scale == AxisScale::logarithmic) return whole_decades(range, begin, end);
  if (range.highest <= range.lowest) {
    const double margin = range.lowest == 0.0 ? 1.0 : 0.5 * std::abs(range.lowest);
    range = {range.lowest - margin, range.highest + margin};
  }
  const double step = round_step(range.highest - range.lowest, ticks);
  return {step * std::floor(range.lowest / step + kStepRounding),
          step * std::ceil(range.highest / step - kStepRounding), begin, end, AxisScale::linear};
}

std::vector<Tick> ticks_of(const AxisMap& axis, int count) {
  std::vector<Tick> ticks;
  if (axis.scale == AxisScale::logarithmic) {
    const auto last = static_cast<int>(std::floor(std::log10(axis.highest) + kStepRounding));
    for (auto e = static_cast<int>(std::ceil(std::log10(axis.lowest) - kStepRounding)); e <= last; ++e)
      ticks.push_back({std::pow(10.0, e), power_of_ten(e)});
    return ticks;
  }
  const double step = round_step(axis.highest - axis.lowest, count);
  for (double k = std::ceil(axis.lowest / step - kStepRounding);
       k * step <= axis.highest + kStepRounding * step; ++k)
    ticks.push_back({k * step, fmt::format("{:.6g}", k == 0.0 ? 0.0 : k * step)});
  return ticks;
}

}  // namespace voussoir
