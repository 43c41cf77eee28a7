#pragma once
/// @file What all noise shapes need to know of the errors of candidate scenes.

#include <vector>

#include "database/records/database.h"
#include "lookup/evidence/row_at_levels.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// How the instruments' errors and the model's own go together.
enum class ErrorSum {
  variance,  ///< scale_i^2 = instrument^2 + model's variance: Gaussian, and near enough Laplace and Student
  beyond  ///< scale_i = instrument; of an error only what two deviations of the model do not explain counts
};

/// Sums over the readings of z_i = (reading_i - d_i) / scale_i; d_i is multiplied by the common factor that
/// fits best where that is unknown (scale_fit.h).
struct RowStatistics {
  double sum_absolute = 0.0;     ///< sum |z_i|; NaN if a reading has no prediction: the scene is impossible
  double sum_square = 0.0;       ///< sum z_i^2
  double largest = 0.0;          ///< max |z_i|
  double sum_log_scale = 0.0;    ///< sum log scale_i [log m]
  double sum_log_student = 0.0;  ///< sum log(1 + z_i^2 / (nu - 2)), nu being the degrees of freedom
  double scale_square = 0.0;     ///< ScaleFit::square; its log_width is in `sum_log_scale`
};

/// The statistics of some rows, column by column.
struct TableStatistics {
  std::vector<double> sum_absolute, sum_square, largest, sum_log_scale, sum_log_student, scale_square;

  std::size_t rows() const { return largest.size(); }
  RowStatistics row(std::size_t i) const {
    return {sum_absolute[i],  sum_square[i],      largest[i],
            sum_log_scale[i], sum_log_student[i], scale_square[i]};
  }
};

/// Of these rows of a table, in their order. Without a model error both sums are the same. Of Gaussian noise
/// with a model error only the squares and the scales are worked out (`sum_absolute` is NaN where it would
/// be).
TableStatistics table_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table, std::span<const std::size_t> rows,
                                 ErrorSum sum = ErrorSum::variance);

/// Of one row at one level (ErrorSum::variance), whose errors have the scale 1 at places that are filled up.
RowStatistics row_statistics(const LevelPlaces& places);

}  // namespace voussoir
