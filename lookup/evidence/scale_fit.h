#pragma once
/// @file The common factor of all movements, which no model knows exactly: joints that are 1 % stiffer
/// everywhere make every displacement 1 % smaller, and so does another program's mesh.
///
/// Readings are y = c m + errors with movements m and c ~ N(1, tau^2). With D the diagonal of the errors'
/// variances, c is fitted by least squares with its prior,
///     c = (m' D^-1 y + 1 / tau^2) v,    v = 1 / (m' D^-1 m + 1 / tau^2),
/// and the Gaussian marginal over c is, exactly, N(y; c m, D) exp(-(c - 1)^2 / (2 tau^2)) sqrt(v) / tau.
/// Other shapes take the same fit.

#include <vector>

#include "database/records/database.h"
#include "lookup/evidence/row_at_levels.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// Of a row; as it stands where the factor is known.
struct ScaleFit {
  double factor = 1.0;     ///< c
  double variance = 0.0;   ///< v
  double square = 0.0;     ///< ((c - 1) / tau)^2
  double log_width = 0.0;  ///< log(tau / sqrt(v))
};

/// Variance of an error that is even within a bound of one.
inline constexpr double kBoundedVariance = 1.0 / 3.0;

/// `common` are the rows' common_variances; `instrument_variance` is that of an instrument's error in units
/// of its scale squared: 1, or kBoundedVariance.
std::vector<ScaleFit> scale_fits(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table, std::span<const std::size_t> rows,
                                 std::span<const double> common, double instrument_variance);

/// The same of one row at one level.
ScaleFit scale_fit(const LevelPlaces& places, double instrument_variance);

/// What the likelihood of a row needs of its own.
struct RowTerms {
  double common = 0.0;    ///< variance of the model that all points share [m2]
  double factor = 1.0;    ///< of all movements
  double variance = 0.0;  ///< of that factor
};

/// One for each row.
std::vector<RowTerms> row_terms(std::span<const double> common, std::span<const ScaleFit> fits);

}  // namespace voussoir
