#include "lookup/unknown/scatter_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/simd/lane_math.h"
#include "core/simd/wide_lanes.h"
#include "lookup/unknown/scatter_factorisation.h"

namespace voussoir {
namespace {

static_assert(kScatterFactors.size() == kLanes, "one lane for each");

/// What a density is made of, and where its lanes are worked out.
template <class Lanes>
struct Density {
  std::size_t n;
  const double *difference, *bridge;
  std::array<const double*, 2> noise;
  ScatterFactorisation<Lanes> factorisation;

  VOUSSOIR_INLINE Lanes kappa() const {
    Lanes result;
    for (std::size_t k = 0; k < sizeof(Lanes) / sizeof(double); ++k) result[k] = kScatterFactors[k % kLanes];
    return result;
  }
  VOUSSOIR_INLINE Lanes noise_at(std::size_t at) const {
    if constexpr (sizeof(Lanes) == sizeof(DoubleLanes)) {
      return Lanes{} + noise[0][at];
    } else {
      const Lanes one = Lanes{} + noise[0][at], two = Lanes{} + noise[1][at];
      return __builtin_shufflevector(one, two, 0, 1, 2, 3, 8, 9, 10, 11);
    }
  }

  /// The matrix, filled up with rows of the identity, and the difference as its last row: what is left there
  /// of the diagonal is the quadratic form, but for its sign.
  VOUSSOIR_INLINE void fill() const {
    const Lanes factors = kappa();
    Lanes* to = factorisation.lower;
    for (std::size_t at = 0; at < lower_size(n); ++at, ++to) *to = noise_at(at) + factors * bridge[at];
    const std::size_t last = factorisation.n - 1;
    for (std::size_t i = n; i <= last; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++to) *to = Lanes{} + (i < last && i == j ? 1.0 : 0.0);
    for (std::size_t j = 0; j < n; ++j) factorisation.row(last)[j] += difference[j];
  }
};

VOUSSOIR_FOR_EVERY_PROCESSOR
void work_out(const Density<DoubleLanes>& density) {
  density.fill();
  density.factorisation.factorise();
}

VOUSSOIR_WIDE void work_out_wide(const Density<WideLanes>& density) {
  density.fill();
  density.factorisation.factorise();
}

/// From the pivots of so many lanes.
ScatterLogs logs_of(const double* pivots, std::size_t lanes, std::size_t n, std::size_t last) {
  ScatterLogs logs;
  logs.fill(static_cast<double>(n) * std::log(2.0 * std::numbers::pi));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < kLanes; ++k) logs[k] += pivots[i * lanes + k];
  for (std::size_t k = 0; k < kLanes; ++k) logs[k] = -0.5 * (logs[k] - pivots[last * lanes + k]);
  return logs;
}

}  // namespace

template <class Lanes, class Work>
std::array<ScatterLogs, 2> ScatterDensity::work_out_with(Work work, const std::vector<double>& difference,
                                                         std::array<const double*, 2> noise,
                                                         const LowerTriangle& bridge) {
  constexpr std::size_t kWidth = sizeof(Lanes) / sizeof(double);
  const std::size_t n = difference.size(), all = padded(n + 1);
  memory_.resize(lower_size(all) + 2 * all);
  Lanes* const lower = reinterpret_cast<Lanes*>(memory_.data());
  Lanes *const inverse = lower + lower_size(all), *const pivots = inverse + all;
  work({n, difference.data(), bridge.data(), noise, {all, lower, inverse, pivots}});
  double* const numbers = reinterpret_cast<double*>(pivots);
  make_logarithms(std::span(numbers, n * kWidth));
  std::array<ScatterLogs, 2> logs{};
  for (std::size_t k = 0; k < kWidth / kLanes; ++k)
    logs[k] = logs_of(numbers + k * kLanes, kWidth, n, all - 1);
  return logs;
}

ScatterLogs ScatterDensity::operator()(const std::vector<double>& difference, const LowerTriangle& noise,
                                       const LowerTriangle& bridge) {
  return work_out_with<DoubleLanes>(work_out, difference, {noise.data(), nullptr}, bridge)[0];
}

std::array<ScatterLogs, 2> ScatterDensity::operator()(const std::vector<double>& difference,
                                                      const LowerTriangle& noise, const LowerTriangle& other,
                                                      const LowerTriangle& bridge) {
  if (!has_wide_registers()) return {(*this)(difference, noise, bridge), (*this)(difference, other, bridge)};
  return work_out_with<WideLanes>(work_out_wide, difference, {noise.data(), other.data()}, bridge);
}

double over_scatter(const ScatterLogs& logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(largest)) return largest;  // impossible under all
  double sum = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) sum += kScatterPrior[k] * std::exp(logs[k] - largest);
  return largest + std::log(sum);
}

}  // namespace voussoir
