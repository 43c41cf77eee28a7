#pragma once
/// @file The density of readings under a covariance that is known but for the scatter of the bridge.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/simd/lanes.h"
#include "lookup/evidence/scatter_factor.h"

namespace voussoir {

/// A symmetric matrix: row i of its lower triangle begins at place i (i + 1) / 2.
using LowerTriangle = std::vector<double>;

constexpr std::size_t lower_size(std::size_t n) {
  return n * (n + 1) / 2;
}

LowerTriangle lower_of(const Eigen::MatrixXd& matrix);

/// A logarithm for each of kScatterFactors.
using ScatterLogs = std::array<double, kScatterFactors.size()>;

/// Numbers of columns are filled up with zeros to a whole number of lanes.
constexpr std::size_t padded(std::size_t columns) {
  return (columns + kLanes - 1) / kLanes * kLanes;
}

/// Adds A A^T to a lower triangle. A: so many rows of padded(columns) numbers, one after the other.
void add_outer_product(const std::vector<double>& a, std::size_t rows, LowerTriangle& sum);

/// Adds A B^T + B A^T of two of the same shape.
void add_symmetric_product(const std::vector<double>& a, const std::vector<double>& b, std::size_t rows,
                           LowerTriangle& sum);

/// Factorises noise + kappa * bridge for all kScatterFactors side by side. Keeps its memory for the next
/// call.
class ScatterDensity {
 public:
  /// log N(difference; 0, noise + kappa bridge) for each kappa; NaN where that is not positive definite.
  ScatterLogs operator()(const std::vector<double>& difference, const LowerTriangle& noise,
                         const LowerTriangle& bridge);

 private:
  LaneVector factor_;  // lower triangle, and the difference as one more row
  LaneVector inverse_;
  std::vector<double> pivots_;
};

/// log of the mean over kappa with the weights kScatterPrior.
double over_scatter(const ScatterLogs& logs);

}  // namespace voussoir
