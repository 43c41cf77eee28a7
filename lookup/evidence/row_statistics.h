#pragma once
/// @file What all noise shapes need to know of the errors of one candidate scene.

#include <vector>

#include "database/records/database.h"
#include "lookup/readings/measurements.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// The readings that can tell scenes apart, with what the noise model says of each, in the order of the
/// database's points: scale_i = slope_i |d_i| + offset_i + model_error |d_i - intact_i|.
struct Observation {
  std::vector<double> reading;  ///< [m], NaN where there is none or where nothing can move
  std::vector<double> slope;    ///< [-] zero where there is no reading
  std::vector<double> offset;   ///< [m] one where there is no reading
  std::vector<double> intact;   ///< [m] displacements of the intact bridge
  double model_error = 0.0;     ///< [-]
  double unit = 1.0;            ///< [m] a typical scale, which keeps products of scales within range
  std::size_t count = 0;        ///< readings
};

/// Sums over the readings of z_i = (reading_i - d_i) / scale_i.
struct RowStatistics {
  double sum_absolute = 0.0;   ///< sum |z_i|; NaN if a reading has no prediction: the scene is impossible
  double sum_square = 0.0;     ///< sum z_i^2
  double largest = 0.0;        ///< max |z_i|
  double sum_log_scale = 0.0;  ///< sum log scale_i [log m]
};

/// The observation for a noise level. `intact` are the displacements of the intact bridge: points that do not
/// move there (clamped) move in no scene; their readings say nothing and are left out.
Observation observe(const Measurements& measurements, std::span<const double> intact, const NoiseModel& noise,
                    double level);

/// The statistics of every row of a table, column by column.
struct TableStatistics {
  std::vector<double> sum_absolute, sum_square, largest, sum_log_scale;

  std::size_t rows() const { return largest.size(); }
  RowStatistics row(std::size_t i) const {
    return {sum_absolute[i], sum_square[i], largest[i], sum_log_scale[i]};
  }
};
TableStatistics table_statistics(const Observation& observation, const SceneTable& table);

/// scale_i of one row [m]; NaN where there is no reading.
std::vector<double> error_scales(const Observation& observation, std::span<const double> prediction);

/// z_i of one row; NaN where there is no reading.
std::vector<double> standard_errors(const Observation& observation, std::span<const double> prediction);

}  // namespace voussoir
