#include "lookup/evidence/bounded_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/simd/lane_math.h"
#include "lookup/evidence/point_arrays.h"
#include "lookup/evidence/scale_fit.h"
#include "lookup/evidence/wide_product.h"
#include "lookup/readings/common_variance.h"

namespace voussoir {
namespace {

constexpr double kSmallestDeviation = 1e-12;  // [m] a model error below it counts as that
constexpr double kFarInside = 6.5;       // deviations from the bound inside of which it is not felt: 4e-11
constexpr std::size_t kFewProducts = 4;  // of factors that may be as small as 1e-60
constexpr double kNarrow = 0.02;         // half-widths below this many deviations are narrow

/// Q(x) = exp(exponent) factor, for x >= 0, within 1.2e-7 of it (Numerical Recipes, erfcc: Chebyshev fit).
template <class T>
struct Tail {
  T exponent, factor;
};
template <class T>
VOUSSOIR_INLINE Tail<T> gaussian_tail(const T& x) {
  const T z = x * (1.0 / std::numbers::sqrt2);
  const T t = 1.0 / (1.0 + 0.5 * z);
  T series = T{} + 0.17087277;
  for (const double c : {-0.82215223, 1.48851587, -1.13520398, 0.27886807, -0.18628806, 0.09678418,
                         0.37409196, 1.00002368, -1.26551223})
    series = series * t + c;
  return {series - z * z, 0.5 * t};
}

VOUSSOIR_INLINE DoubleLanes exponential(DoubleLanes x) {
  make_exponential(x);
  return x;
}

/// The density where the bound is narrow against the deviation, and the difference of tails would be lost in
/// round-off: the Gaussian's times sinh(q) / q with q = e b / s^2, less what the Gaussian falls off across
/// the bound, b^2 / (6 s^2).
VOUSSOIR_INLINE Tail<DoubleLanes> narrow_density(const DoubleLanes& size, const DoubleLanes& half_width,
                                                 const DoubleLanes& deviation) {
  const DoubleLanes share = half_width / deviation, z = size / deviation;
  const DoubleLanes q = larger(z * share, DoubleLanes{} + 1e-9);
  const DoubleLanes sinh_per_q = (1.0 - exponential(-2.0 * q)) / (2.0 * q);  // without its factor exp(q)
  constexpr double kPeak = std::numbers::inv_sqrtpi / std::numbers::sqrt2;
  return {q - 0.5 * z * z, kPeak * sinh_per_q * (1.0 - share * share * (1.0 / 6.0)) / deviation};
}

constexpr double kGone =
    22.0;  // squares that lie so far apart: tails, by 20 in the logarithm; lost beside their error

/// The density times 2 b as exp(exponent) factor.
VOUSSOIR_INLINE Tail<DoubleLanes> bounded_density(const DoubleLanes& size, const DoubleLanes& half_width,
                                                  const DoubleLanes& deviation) {
  const DoubleLanes zero{};
  const DoubleLanes from_bound = (size - half_width) / deviation;
  const Tail<DoubleLanes> near = gaussian_tail(magnitude(from_bound));
  const DoubleMask is_outside = from_bound >= 0.0, is_narrow = half_width < kNarrow * deviation;
  DoubleLanes outside = near.factor, inside = 1.0 - near.factor * exponential(near.exponent);
  if (any(2.0 * size * half_width < kGone * deviation * deviation)) {
    const Tail<DoubleLanes> far = gaussian_tail((size + half_width) / deviation);
    outside -= far.factor * exponential(far.exponent - near.exponent);
    inside -= far.factor * exponential(far.exponent);
  }
  Tail<DoubleLanes> density{is_outside ? near.exponent : zero, is_outside ? outside : inside};
  if (!any(is_narrow)) return density;
  const Tail<DoubleLanes> narrow = narrow_density(size, half_width, deviation);
  return {is_narrow ? narrow.exponent : density.exponent,
          is_narrow ? 2.0 * half_width * narrow.factor : density.factor};
}

/// At least the density times 2 b, as which Q(x) <= exp(-x^2 / 2) serves: no tail is worked out.
VOUSSOIR_INLINE Tail<DoubleLanes> highest_density(const DoubleLanes& size, const DoubleLanes& half_width,
                                                  const DoubleLanes& variance) {
  const DoubleLanes beyond = size - half_width;
  const DoubleLanes outside = beyond < 0.0 ? DoubleLanes{} : beyond;  // NaN stays
  return {-0.5 * outside * outside / variance, DoubleLanes{} + 1.0};
}

/// The density times 2 b where the bound is felt, one elsewhere.
VOUSSOIR_INLINE Tail<DoubleLanes> felt_density(const DoubleLanes& size, const DoubleLanes& half_width,
                                               const DoubleLanes& variance, const DoubleMask& has_reading) {
  const DoubleLanes one = DoubleLanes{} + 1.0, deviation = square_root(variance);
  const DoubleMask is_felt = has_reading & ~(size + kFarInside * deviation < half_width);
  if (!any(is_felt)) return {DoubleLanes{}, one};
  const Tail<DoubleLanes> density = bounded_density(size, half_width, deviation);
  return {is_felt ? density.exponent : DoubleLanes{}, is_felt ? density.factor : one};
}

/// Sum of the densities' exponents; the product of their factors, times the unit each, goes to `factors`. NaN
/// if a reading has no prediction.
template <bool kHighest, class Places>
VOUSSOIR_INLINE double log_likelihood_of_row(const Places& places, double inverse_unit, const RowTerms& row,
                                             WideProduct& factors) {
  const DoubleLanes one = DoubleLanes{} + 1.0;
  DoubleLanes exponents{}, product = one;
  for_lanes(places.count(), [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    const PointLanes at = places.lanes(i, some);
    const DoubleMask has_reading = at.reading == at.reading;
    if (!any(has_reading)) return;
    const DoubleLanes movement = at.predicted - at.origin, half_width = at.instrument;
    const DoubleLanes variance = larger(at.variance + row.variance * movement * movement,
                                        DoubleLanes{} + kSmallestDeviation * kSmallestDeviation);
    const DoubleLanes size = magnitude(at.reading - at.origin - row.factor * movement);
    Tail<DoubleLanes> density;
    if constexpr (kHighest)
      density = highest_density(size, half_width, variance);
    else
      density = felt_density(size, half_width, variance, has_reading);
    exponents += has_reading ? (size == size ? density.exponent : size) : DoubleLanes{};
    product *= has_reading ? density.factor / (2.0 * half_width * inverse_unit) : one;
    if ((i / kLanes) % kFewProducts == 0) flush(product, factors);
  });
  flush(product, factors);
  return sum_of(exponents);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect(const PointArrays& arrays, double inverse_unit, const double* table, const std::size_t* rows,
             const RowTerms* terms, std::size_t count, double* results, WideProduct* factors) {
  for (std::size_t i = 0; i < count; ++i)
    results[i] =
        log_likelihood_of_row<false>(StoredPlaces{arrays, table + rows[i] * arrays.points, terms[i].common},
                                     inverse_unit, terms[i], factors[i]);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_highest(const PointArrays& arrays, double inverse_unit, const double* table,
                     const std::size_t* rows, const RowTerms* terms, std::size_t count, double* results,
                     WideProduct* factors) {
  for (std::size_t i = 0; i < count; ++i)
    results[i] =
        log_likelihood_of_row<true>(StoredPlaces{arrays, table + rows[i] * arrays.points, terms[i].common},
                                    inverse_unit, terms[i], factors[i]);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
double collect_one(const LevelPlaces& places, const RowTerms& terms, WideProduct& factors) {
  return log_likelihood_of_row<false>(places, 1.0, terms, factors);
}

/// What a row's likelihood has beside its sum of exponents.
double log_rest(const WideProduct& factors, const ScaleFit& fit) {
  return logarithm_of(factors) - 0.5 * fit.square - fit.log_width;
}

/// The integral of Q from x to infinity.
double integral_of_tail(double x) {
  const double q = 0.5 * std::erfc(x / std::numbers::sqrt2);
  return std::exp(-0.5 * x * x) * std::numbers::inv_sqrtpi / std::numbers::sqrt2 - x * q;
}

std::vector<double> log_likelihoods(const Observation& observation, const ErrorScales& scales,
                                    const SceneTable& table, std::span<const std::size_t> rows,
                                    decltype(&collect) function) {
  const std::vector<double> common =
      common_variances(observation.intact, observation.error_common, table, rows);
  const std::vector<ScaleFit> fits = scale_fits(observation, scales, table, rows, common, kBoundedVariance);
  const std::vector<RowTerms> terms = row_terms(common, fits);
  std::vector<double> results(rows.size());
  std::vector<WideProduct> factors(rows.size());
  function(point_arrays(observation, scales), 1.0 / scales.unit, table.vertical.data(), rows.data(),
           terms.data(), rows.size(), results.data(), factors.data());
  const double shift = static_cast<double>(observation.count) * std::log(scales.unit);
  for (std::size_t i = 0; i < rows.size(); ++i) results[i] += log_rest(factors[i], fits[i]) - shift;
  return results;
}

}  // namespace

double log_bounded_density(double error, double half_width, double deviation) {
  const Tail<DoubleLanes> density =
      bounded_density(DoubleLanes{} + std::abs(error), DoubleLanes{} + half_width, DoubleLanes{} + deviation);
  return density.exponent[0] + std::log(density.factor[0] / (2.0 * half_width));
}

double chance_of_bounded_error(double error, double half_width, double deviation) {
  const double size = std::abs(error);
  if (half_width < kNarrow * deviation)
    return std::erfc(size / std::sqrt(2.0 * (deviation * deviation + half_width * half_width / 3.0)));
  return std::min(1.0, deviation / half_width *
                           (integral_of_tail((size - half_width) / deviation) -
                            integral_of_tail((size + half_width) / deviation)));
}

std::vector<double> log_bounded_likelihoods(const Observation& observation, const ErrorScales& scales,
                                            const SceneTable& table, std::span<const std::size_t> rows) {
  return log_likelihoods(observation, scales, table, rows, collect);
}

double log_bounded_likelihood(const LevelPlaces& places) {
  const ScaleFit fit = scale_fit(places, kBoundedVariance);
  WideProduct factors;
  const double exponents = collect_one(places, {0.0, fit.factor, fit.variance}, factors);
  return exponents + log_rest(factors, fit);
}

std::vector<double> highest_bounded_likelihoods(const Observation& observation, const ErrorScales& scales,
                                                const SceneTable& table, std::span<const std::size_t> rows) {
  return log_likelihoods(observation, scales, table, rows, collect_highest);
}

}  // namespace voussoir
