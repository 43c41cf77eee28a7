#include "lookup/evidence/scale_fit.h"

#include <cmath>

#include "lookup/evidence/point_arrays.h"

namespace voussoir {
namespace {

/// m' D^-1 y and m' D^-1 m.
struct Products {
  double with_reading, with_itself;
};

template <class Places>
VOUSSOIR_INLINE Products products(const Places& places, double instrument_variance) {
  DoubleLanes with_reading{}, with_itself{};
  for_lanes(places.count(), [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    const PointLanes at = places.lanes(i, some);
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
    results[i] =
        products(StoredPlaces{arrays, table + rows[i] * arrays.points, common[i]}, instrument_variance);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_one(const LevelPlaces& places, double instrument_variance, Products* result) {
  *result = products(places, instrument_variance);
}

ScaleFit fit_of(const Products& sums, double tau) {
  const double prior = 1.0 / (tau * tau);
  const double variance = 1.0 / (sums.with_itself + prior);
  const double factor = (sums.with_reading + prior) * variance;
  return {factor, variance, (factor - 1.0) * (factor - 1.0) * prior, -0.5 * std::log(variance * prior)};
}

}  // namespace

std::vector<ScaleFit> scale_fits(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table, std::span<const std::size_t> rows,
                                 std::span<const double> common, double instrument_variance) {
  std::vector<ScaleFit> fits(rows.size());
  if (observation.unknown_scale == 0.0) return fits;
  std::vector<Products> sums(rows.size());
  collect(point_arrays(observation, scales), table.vertical.data(), rows.data(), rows.size(), common.data(),
          instrument_variance, sums.data());
  for (std::size_t i = 0; i < rows.size(); ++i) fits[i] = fit_of(sums[i], observation.unknown_scale);
  return fits;
}

ScaleFit scale_fit(const LevelPlaces& places, double instrument_variance) {
  const double tau = places.row.observation().unknown_scale;
  if (tau == 0.0) return {};
  Products sums;
  collect_one(places, instrument_variance, &sums);
  return fit_of(sums, tau);
}

std::vector<RowTerms> row_terms(std::span<const double> common, std::span<const ScaleFit> fits) {
  std::vector<RowTerms> terms;
  terms.reserve(common.size());
  for (std::size_t i = 0; i < common.size(); ++i)
    terms.push_back({common[i], fits[i].factor, fits[i].variance});
  return terms;
}

}  // namespace voussoir
