#include "lookup/evidence/row_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/simd/lane_math.h"
#include "lookup/evidence/point_arrays.h"
#include "lookup/evidence/scale_fit.h"
#include "lookup/evidence/wide_product.h"
#include "lookup/readings/common_variance.h"

namespace voussoir {
namespace {

/// Running statistics, lane by lane, with products in place of sums of logarithms.
struct LaneStatistics {
  DoubleLanes sum_absolute{}, sum_square{}, largest{};
  DoubleLanes scales = DoubleLanes{} + 1.0, student = DoubleLanes{} + 1.0;
};

/// What a row is worked out with.
struct View {
  PointArrays arrays;
  double inverse_unit;
  double per_student;  ///< 1 / (nu - 2), or 0 if nobody asks
};

template <bool kModelError, ErrorSum kSum>
VOUSSOIR_INLINE void add_errors(const View& view, std::size_t i, std::size_t count, const double* prediction,
                                const RowTerms& row, LaneStatistics& statistics) {
  const PointLanes at = point_lanes(view.arrays, prediction, i, count, row.common);
  DoubleLanes scale = at.instrument;
  DoubleLanes error = magnitude(at.reading - at.predicted);
  if constexpr (kModelError) {
    const DoubleLanes movement = at.predicted - at.origin;
    error = magnitude(at.reading - at.origin - row.factor * movement);
    if constexpr (kSum == ErrorSum::variance) {
      scale = square_root(scale * scale + at.variance);
    } else {
      const DoubleLanes beyond = error - 2.0 * square_root(at.variance + row.variance * movement * movement);
      error = beyond < 0.0 ? DoubleLanes{} : beyond;  // NaN stays
    }
  }
  const DoubleMask has_reading = at.reading == at.reading;
  const DoubleLanes z = has_reading ? error / scale : DoubleLanes{};
  statistics.sum_absolute += z;
  statistics.sum_square += z * z;
  statistics.largest = z > statistics.largest ? z : statistics.largest;
  statistics.scales *= has_reading ? scale * view.inverse_unit : DoubleLanes{} + 1.0;
  if (view.per_student > 0.0) statistics.student *= 1.0 + z * z * view.per_student;
}

/// All that Gaussian errors need: without roots, which take longest. The product is that of the variances.
VOUSSOIR_INLINE void add_squares(const View& view, std::size_t i, std::size_t count, const double* prediction,
                                 const RowTerms& row, LaneStatistics& statistics) {
  const PointLanes at = point_lanes(view.arrays, prediction, i, count, row.common);
  const DoubleLanes error = at.reading - at.origin - row.factor * (at.predicted - at.origin);
  const DoubleLanes variance = at.instrument * at.instrument + at.variance;
  const DoubleMask has_reading = at.reading == at.reading;
  statistics.sum_square += has_reading ? error * error / variance : DoubleLanes{};
  statistics.scales *= has_reading ? variance * (view.inverse_unit * view.inverse_unit) : DoubleLanes{} + 1.0;
}

/// Where the statistics go; the logarithms are taken of all rows at once, later.
struct Columns {
  double *sum_absolute, *sum_square, *largest;
  double *scale_mantissa, *scale_exponent, *student_mantissa, *student_exponent;
};

template <bool kModelError, ErrorSum kSum>
VOUSSOIR_INLINE void collect_row(const View& view, const double* prediction, const RowTerms& terms,
                                 std::size_t row, const Columns& columns) {
  LaneStatistics lanes;
  WideProduct scales, student;
  const auto flush_both = [&]() __attribute__((always_inline)) {
    flush(lanes.scales, scales);
    if (view.per_student > 0.0) flush(lanes.student, student);
  };
  for_lanes(view.arrays.points, [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    add_errors<kModelError, kSum>(view, i, some, prediction, terms, lanes);
    if ((i / kLanes) % kSafeProducts == 0) flush_both();
  });
  flush_both();
  columns.sum_absolute[row] = sum_of(lanes.sum_absolute);
  columns.sum_square[row] = sum_of(lanes.sum_square);
  columns.largest[row] = largest_of(lanes.largest);
  columns.scale_mantissa[row] = scales.mantissa;
  columns.scale_exponent[row] = scales.exponent;
  columns.student_mantissa[row] = student.mantissa;
  columns.student_exponent[row] = student.exponent;
}

/// Half the exponent of the product of squares, whose mantissa's root is taken.
VOUSSOIR_INLINE void collect_squares_of_row(const View& view, const double* prediction, const RowTerms& terms,
                                            std::size_t row, const Columns& columns) {
  LaneStatistics lanes;
  WideProduct squares;
  for_lanes(view.arrays.points, [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    add_squares(view, i, some, prediction, terms, lanes);
    if ((i / kLanes) % (kSafeProducts / 2) == 0) flush(lanes.scales, squares);
  });
  flush(lanes.scales, squares);
  columns.sum_absolute[row] = columns.sum_square[row] = sum_of(lanes.sum_square);
  columns.scale_mantissa[row] = square_root(squares.mantissa);
  columns.scale_exponent[row] = 0.5 * squares.exponent;
}

using Rows = std::span<const std::size_t>;

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_plain(const View& view, const double* table, Rows rows, const RowTerms* terms,
                   const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    collect_row<false, ErrorSum::variance>(view, table + rows[i] * view.arrays.points, terms[i], i, columns);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_variance(const View& view, const double* table, Rows rows, const RowTerms* terms,
                      const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    collect_row<true, ErrorSum::variance>(view, table + rows[i] * view.arrays.points, terms[i], i, columns);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_squares(const View& view, const double* table, Rows rows, const RowTerms* terms,
                     const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    collect_squares_of_row(view, table + rows[i] * view.arrays.points, terms[i], i, columns);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_beyond(const View& view, const double* table, Rows rows, const RowTerms* terms,
                    const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    collect_row<true, ErrorSum::beyond>(view, table + rows[i] * view.arrays.points, terms[i], i, columns);
}

View view_of(const Observation& observation, const ErrorScales& scales) {
  const double nu = observation.noise.degrees_of_freedom;
  return {point_arrays(observation, scales), 1.0 / scales.unit,
          observation.noise.shape == NoiseShape::student ? 1.0 / (nu - 2.0) : 0.0};
}

/// Mantissas become logarithms of mantissa times two to the exponent, plus a shift.
void make_wide_logarithms(std::vector<double>& mantissa, const std::vector<double>& exponent, double shift) {
  make_logarithms(mantissa);
  for (std::size_t i = 0; i < mantissa.size(); ++i) mantissa[i] += exponent[i] * std::numbers::ln2 + shift;
}

}  // namespace

TableStatistics table_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table, std::span<const std::size_t> rows, ErrorSum sum) {
  const std::vector<double> zeros(rows.size(), 0.0);
  TableStatistics result{zeros, zeros, zeros, zeros, zeros, zeros};
  std::vector<double> scale_exponent = zeros, student_exponent = zeros;
  const View view = view_of(observation, scales);
  const Columns columns{result.sum_absolute.data(),  result.sum_square.data(), result.largest.data(),
                        result.sum_log_scale.data(), scale_exponent.data(),    result.sum_log_student.data(),
                        student_exponent.data()};
  const std::vector<double> common =
      common_variances(observation.intact, observation.error_common, table, rows);
  const ScaleFits fits =
      scale_fits(observation, scales, table, rows, common, sum == ErrorSum::beyond ? kBoundedVariance : 1.0);
  const bool plain = !observation.has_model_error() && observation.unknown_scale == 0.0;
  const auto collect = plain                                             ? collect_plain
                       : sum == ErrorSum::beyond                         ? collect_beyond
                       : observation.noise.shape == NoiseShape::gaussian ? collect_squares
                                                                         : collect_variance;
  collect(view, table.vertical.data(), rows, row_terms(common, fits).data(), columns);
  make_wide_logarithms(result.sum_log_scale, scale_exponent,
                       static_cast<double>(observation.count) * std::log(scales.unit));
  if (view.per_student > 0.0) make_wide_logarithms(result.sum_log_student, student_exponent, 0.0);
  for (std::size_t i = 0; i < fits.factor.size(); ++i) {
    result.scale_square[i] = fits.square[i];
    result.sum_log_scale[i] += fits.log_width[i];
  }
  return result;
}

}  // namespace voussoir
