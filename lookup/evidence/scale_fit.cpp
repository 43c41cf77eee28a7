#include "lookup/evidence/scale_fit.h"

#include <cmath>
#include <limits>

#include "lookup/evidence/point_arrays.h"

namespace voussoir {
namespace {

/// m' D^-1 y and m' D^-1 m.
struct Products {
  double with_reading, with_itself;
};

VOUSSOIR_INLINE Products products(const PointArrays& arrays, const double* prediction, double common,
                                  double instrument_variance) {
  DoubleLanes with_reading{}, with_itself{};
  for_lanes(arrays.points, [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    const PointLanes at = point_lanes(arrays, prediction, i, some, common);
    const DoubleLanes movement = at.predicted - at.origin;
    const DoubleLanes weight = movement / (instrument_variance * at.instrument * at.instrument + at.variance);
    const DoubleMask has_reading = at.reading == at.reading;
    with_reading += has_reading ? weight * (at.reading - at.origin) : DoubleLanes{};
    with_itself += has_reading ? weight * movement : DoubleLanes{};
  });
  return {sum_of(with_reading), sum_of(with_itself)};
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect(const PointArrays& arrays, const double* table, const std::size_t* rows, std::size_t count,
             const double* common, double instrument_variance, Products* results) {
  for (std::size_t i = 0; i < count; ++i)
    results[i] = products(arrays, table + rows[i] * arrays.points, common[i], instrument_variance);
}

}  // namespace

ScaleFits scale_fits(const Observation& observation, const ErrorScales& scales, const SceneTable& table,
                     std::span<const std::size_t> rows, std::span<const double> common,
                     double instrument_variance) {
  ScaleFits fits;
  if (observation.unknown_scale == 0.0) return fits;
  std::vector<Products> sums(rows.size());
  collect(point_arrays(observation, scales), table.vertical.data(), rows.data(), rows.size(), common.data(),
          instrument_variance, sums.data());
  const double tau = observation.unknown_scale;
  const double prior = 1.0 / (tau * tau);
  for (const Products& sum : sums) {
    const double variance = 1.0 / (sum.with_itself + prior);
    const double factor = (sum.with_reading + prior) * variance;
    fits.factor.push_back(factor);
    fits.variance.push_back(variance);
    fits.square.push_back((factor - 1.0) * (factor - 1.0) * prior);
    fits.log_width.push_back(-0.5 * std::log(variance * prior));
  }
  return fits;
}

std::vector<RowTerms> row_terms(std::span<const double> common, const ScaleFits& fits) {
  std::vector<RowTerms> terms;
  terms.reserve(common.size());
  for (const double variance : common) terms.push_back({.common = variance});
  for (std::size_t i = 0; i < fits.factor.size(); ++i) {
    terms[i].factor = fits.factor[i];
    terms[i].variance = fits.variance[i];
  }
  return terms;
}

}  // namespace voussoir
