#pragma once
/// @file The density of readings under a covariance that is known but for the scatter of the bridge.

#include <array>
#include <cstddef>
#include <vector>

#include "core/simd/lanes.h"
#include "core/simd/lower_triangle.h"
#include "lookup/unknown/scatter_factor.h"

namespace voussoir {

/// A logarithm for each of kScatterFactors.
using ScatterLogs = std::array<double, kScatterFactors.size()>;

/// The density of one difference under noise + kappa * bridge for all kScatterFactors side by side, and for
/// two noises where the processor's registers hold them. Keeps its memory for the next call.
class ScatterDensity {
 public:
  /// log N(difference; 0, noise + kappa bridge) for each kappa; NaN where that is not positive definite.
  ScatterLogs operator()(const std::vector<double>& difference, const LowerTriangle& noise,
                         const LowerTriangle& bridge);

  /// The same, number by number, for each of two noises.
  std::array<ScatterLogs, 2> operator()(const std::vector<double>& difference, const LowerTriangle& noise,
                                        const LowerTriangle& other, const LowerTriangle& bridge);

 private:
  template <class Lanes, class Work>
  std::array<ScatterLogs, 2> work_out_with(Work work, const std::vector<double>& difference,
                                           std::array<const double*, 2> noise, const LowerTriangle& bridge);

  std::vector<Cell<LanesOf<double, 2 * kLanes>::Type>> memory_;  // for the widest registers
};

/// log of the mean over kappa with the weights kScatterPrior.
double over_scatter(const ScatterLogs& logs);

}  // namespace voussoir
