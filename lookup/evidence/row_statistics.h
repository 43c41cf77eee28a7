#pragma once
/// @file What all noise shapes need to know of the errors of one candidate scene.

#include <vector>

#include "database/records/database.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// Sums over the readings of z_i = (reading_i - d_i) / scale_i, scale_i being the noise_scale.
struct RowStatistics {
  double sum_absolute = 0.0;   ///< sum |z_i|; NaN if a reading has no prediction: the scene is impossible
  double sum_square = 0.0;     ///< sum z_i^2
  double largest = 0.0;        ///< max |z_i|
  double sum_log_scale = 0.0;  ///< sum log scale_i [log m]
};

/// The statistics of every row of a table, column by column.
struct TableStatistics {
  std::vector<double> sum_absolute, sum_square, largest, sum_log_scale;

  std::size_t rows() const { return largest.size(); }
  RowStatistics row(std::size_t i) const {
    return {sum_absolute[i], sum_square[i], largest[i], sum_log_scale[i]};
  }
};
TableStatistics table_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table);

/// z_i of one row; NaN where there is no reading.
std::vector<double> standard_errors(const Observation& observation, const ErrorScales& scales,
                                    std::span<const double> prediction);

}  // namespace voussoir
