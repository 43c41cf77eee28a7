#include "lookup/checks/plausible_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/median.h"
#include "core/units.h"

namespace voussoir {
namespace {

constexpr std::size_t kFewest = 10;      // readings that say something of their scatter
constexpr double kLeastOfErrors = 0.15;  // whoever states errors seven times too large is asked about it, too
constexpr double kRounding = 0.29;     // of a step: the standard deviation of what rounding to it takes away
constexpr double kMostOfErrors = 4.0;  // a step; somewhat more than rounding explains
constexpr std::array kSteps = {100.0, 50.0, 20.0, 10.0, 5.0,  2.0,   1.0,   0.5,
                               0.2,   0.1,  0.05, 0.02, 0.01, 0.005, 0.002, 0.001};  // [mm]

/// Of readings that say how far something moved, and have errors of their own [mm].
struct Stated {
  std::vector<double> movement, error;
};

Stated stated_readings(const Observation& observation) {
  const ErrorScales scales = scales_at(observation, observation.noise.relative.value_or(0.0));
  Stated stated;
  for (std::size_t i = 0; i < observation.reading.size(); ++i) {
    if (std::isnan(observation.reading[i]) || observation.share[i] != 0.0) continue;
    stated.movement.push_back(kMillimetres * (observation.reading[i] - observation.origin[i]));
    stated.error.push_back(kMillimetres * scales.offset[i]);
  }
  return stated;
}

bool are_multiples(const std::vector<double>& values, double step) {
  constexpr double kRoundOff = 1e-9;  // [mm]
  return std::ranges::all_of(
      values, [&](double value) { return std::abs(value - step * std::round(value / step)) < kRoundOff; });
}

/// Root mean square of the movements in units of their errors.
double size_of(const Stated& stated) {
  double square = 0.0;
  for (std::size_t i = 0; i < stated.movement.size(); ++i)
    square += std::pow(stated.movement[i] / stated.error[i], 2);
  return std::sqrt(square / static_cast<double>(stated.movement.size()));
}

Fit unexplained(std::string reason) {
  return {false, 0.0, std::move(reason)};
}

Fit too_calm(double times) {
  return unexplained(
      fmt::format("they scatter by {:.2g} of what their errors let expect; are they in millimetres, and "
                  "the errors so large?",
                  times));
}

/// The coarsest step of which all are multiples [mm]; 0: none.
double step_of(const std::vector<double>& values) {
  const auto step = std::ranges::find_if(kSteps, [&](double one) { return are_multiples(values, one); });
  return step == kSteps.end() ? 0.0 : *step;
}

std::optional<Fit> check_step(double step, const Stated& stated) {
  if (step <= kMostOfErrors * median(stated.error)) return std::nullopt;
  return unexplained(
      fmt::format("all readings are multiples of {:g} mm; rounding to it alone is an error of {:.2g} mm, are "
                  "the stated ones that large?",
                  step, kRounding * step));
}

/// Of changes that are all zero what was read at the first time says how finely it was read, unless gauges
/// were set to zero then.
std::optional<Fit> check_zeros(const Comparison& comparison, const Stated& stated) {
  std::vector<double> before;
  for (const double reading : comparison.before)
    if (!std::isnan(reading) && reading != 0.0) before.push_back(kMillimetres * reading);
  if (before.empty())
    return unexplained(
        "all changes are zero, which does not show how finely they were read; expected before_mm and "
        "after_mm");
  return check_step(step_of(before), stated);
}

}  // namespace

std::optional<Fit> check_readings(const Comparison& comparison, const Observation& observation) {
  const Stated stated = stated_readings(observation);
  if (stated.movement.size() < kFewest) return std::nullopt;
  if (is_change(comparison.kind)) {
    const double size = size_of(stated);
    if (size == 0.0) return check_zeros(comparison, stated);
    if (size < kLeastOfErrors) return too_calm(size);
  }
  return check_step(step_of(stated.movement), stated);
}

std::optional<Fit> check_scatter(const UnknownBridge& bridge, const BridgePosterior& posterior) {
  // What the intact bridge shows hardly scatters where a bridge is just as its file says.
  if (!bridge.movement.isZero(0.0) || bridge.has_first_epoch() || bridge.rows.size() < kFewest)
    return std::nullopt;
  const double scatter = std::sqrt(posterior.square);
  // Without any it is check_readings that knows why.
  return scatter > 0.0 && scatter < kLeastOfErrors ? std::optional(too_calm(scatter)) : std::nullopt;
}

}  // namespace voussoir
