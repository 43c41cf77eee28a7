#pragma once
/// @file What the loss of blocks changes in readings: by how much, and how well that is known.

#include <Eigen/Core>
#include <vector>

#include "lookup/readings/comparison.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// A number of y: after * (channel in the second epoch) + before * (in the first, with no block missing).
struct ReadingRow {
  std::size_t channel = 0;
  double before = 0.0;
  double after = 1.0;
};

/// Of one block, or of a pair whose own factors are stored. Rows are those of y.
struct Loss {
  SceneFactors factors{};      ///< of the parameters of the bridge, and of each epoch; may be not known
  Eigen::VectorXd signal{};    ///< [m] NaN at readings that the loss makes impossible
  Eigen::VectorXd variance{};  ///< [m2] the model's own error in it, and what the first order leaves
  bool known() const { return factors.known(); }
};

/// The loss that makes a row of the comparison's table; `change`: its factors by channel, which may be not
/// known. Factors of epochs have `epochs` times the parameters' columns; those of the second come last.
Loss loss_of(const Comparison& comparison, const Observation& observation,
             const std::vector<ReadingRow>& rows, std::size_t row, const SceneFactors& change,
             Eigen::Index epochs);

/// What the row of a table differs from the intact bridge [m]; rows are those of y.
Eigen::VectorXd signal_of(const Observation& observation, const std::vector<ReadingRow>& rows,
                          std::span<const double> prediction);

/// Standard deviation of a signal as a share of it: the median of the losses whose factors are known; 1 if
/// none are.
double typical_spread(const std::vector<Loss>& losses);

}  // namespace voussoir
