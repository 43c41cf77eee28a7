#include "lookup/evidence/row_statistics.h"

#include <cmath>
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

/// How sums are taken.
struct SumRule {
  double inverse_unit;
  double per_student;  ///< 1 / (nu - 2), or 0 if nobody asks
};
struct View {
  PointArrays arrays;
  SumRule rule;
};

/// Of a row, added up.
struct RowSums {
  double sum_absolute, sum_square, largest;
  WideProduct scales{}, student{};
};

template <bool kModelError, ErrorSum kSum>
VOUSSOIR_INLINE void add_errors(const PointLanes& at, const RowTerms& row, const SumRule& rule,
                                LaneStatistics& statistics) {
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
  statistics.scales *= has_reading ? scale * rule.inverse_unit : DoubleLanes{} + 1.0;
  if (rule.per_student > 0.0) statistics.student *= 1.0 + z * z * rule.per_student;
}

/// All that Gaussian errors need: without roots, which take longest. The product is that of the variances.
VOUSSOIR_INLINE void add_squares(const PointLanes& at, const RowTerms& row, const SumRule& rule,
                                 LaneStatistics& statistics) {
  const DoubleLanes error = at.reading - at.origin - row.factor * (at.predicted - at.origin);
  const DoubleLanes variance = at.instrument * at.instrument + at.variance;
  const DoubleMask has_reading = at.reading == at.reading;
  statistics.sum_square += has_reading ? error * error / variance : DoubleLanes{};
  statistics.scales *= has_reading ? variance * (rule.inverse_unit * rule.inverse_unit) : DoubleLanes{} + 1.0;
}

/// Where the statistics go; the logarithms are taken of all rows at once, later.
struct Columns {
  double *sum_absolute, *sum_square, *largest;
  double *scale_mantissa, *scale_exponent, *student_mantissa, *student_exponent;
};

template <bool kModelError, ErrorSum kSum, class Places>
VOUSSOIR_INLINE RowSums sums_of_row(const Places& places, const RowTerms& terms, const SumRule& rule) {
  LaneStatistics lanes;
  WideProduct scales, student;
  const auto flush_both = [&]() __attribute__((always_inline)) {
    flush(lanes.scales, scales);
    if (rule.per_student > 0.0) flush(lanes.student, student);
  };
  for_lanes(places.count(), [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    add_errors<kModelError, kSum>(places.lanes(i, some), terms, rule, lanes);
    if ((i / kLanes) % kSafeProducts == 0) flush_both();
  });
  flush_both();
  return {sum_of(lanes.sum_absolute), sum_of(lanes.sum_square), largest_of(lanes.largest), scales, student};
}

/// Half the exponent of the product of squares, whose mantissa's root is taken.
template <class Places>
VOUSSOIR_INLINE RowSums squares_of_row(const Places& places, const RowTerms& terms, const SumRule& rule) {
  LaneStatistics lanes;
  WideProduct squares;
  for_lanes(places.count(), [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
    add_squares(places.lanes(i, some), terms, rule, lanes);
    if ((i / kLanes) % (kSafeProducts / 2) == 0) flush(lanes.scales, squares);
  });
  flush(lanes.scales, squares);
  const double sum = sum_of(lanes.sum_square);
  return {sum, sum, 0.0, {square_root(squares.mantissa), 0.5 * squares.exponent}, {}};
}

VOUSSOIR_INLINE void store(const RowSums& sums, std::size_t row, const Columns& columns) {
  columns.sum_absolute[row] = sums.sum_absolute;
  columns.sum_square[row] = sums.sum_square;
  columns.largest[row] = sums.largest;
  columns.scale_mantissa[row] = sums.scales.mantissa;
  columns.scale_exponent[row] = sums.scales.exponent;
  columns.student_mantissa[row] = sums.student.mantissa;
  columns.student_exponent[row] = sums.student.exponent;
}

using Rows = std::span<const std::size_t>;

VOUSSOIR_INLINE StoredPlaces places_of(const View& view, const double* table, std::size_t row,
                                       const RowTerms& terms) {
  return {view.arrays, table + row * view.arrays.points, terms.common};
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_plain(const View& view, const double* table, Rows rows, const RowTerms* terms,
                   const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    store(sums_of_row<false, ErrorSum::variance>(places_of(view, table, rows[i], terms[i]), terms[i],
                                                 view.rule),
          i, columns);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_variance(const View& view, const double* table, Rows rows, const RowTerms* terms,
                      const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    store(
        sums_of_row<true, ErrorSum::variance>(places_of(view, table, rows[i], terms[i]), terms[i], view.rule),
        i, columns);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_squares(const View& view, const double* table, Rows rows, const RowTerms* terms,
                     const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    store(squares_of_row(places_of(view, table, rows[i], terms[i]), terms[i], view.rule), i, columns);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_beyond(const View& view, const double* table, Rows rows, const RowTerms* terms,
                    const Columns& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    store(sums_of_row<true, ErrorSum::beyond>(places_of(view, table, rows[i], terms[i]), terms[i], view.rule),
          i, columns);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_one(const LevelPlaces& places, const RowTerms& terms, const SumRule& rule, RowSums* sums) {
  *sums = sums_of_row<true, ErrorSum::variance>(places, terms, rule);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_squares_of_one(const LevelPlaces& places, const RowTerms& terms, const SumRule& rule,
                            RowSums* sums) {
  *sums = squares_of_row(places, terms, rule);
}

SumRule rule_of(const Observation& observation, double unit) {
  const double nu = observation.noise.degrees_of_freedom;
  return {1.0 / unit, observation.noise.shape == NoiseShape::student ? 1.0 / (nu - 2.0) : 0.0};
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
  const View view{point_arrays(observation, scales), rule_of(observation, scales.unit)};
  const Columns columns{result.sum_absolute.data(),  result.sum_square.data(), result.largest.data(),
                        result.sum_log_scale.data(), scale_exponent.data(),    result.sum_log_student.data(),
                        student_exponent.data()};
  const std::vector<double> common =
      common_variances(observation.intact, observation.error_common, table, rows);
  const std::vector<ScaleFit> fits =
      scale_fits(observation, scales, table, rows, common, sum == ErrorSum::beyond ? kBoundedVariance : 1.0);
  const bool plain = !observation.has_model_error() && observation.unknown_scale == 0.0;
  const auto collect = plain                                             ? collect_plain
                       : sum == ErrorSum::beyond                         ? collect_beyond
                       : observation.noise.shape == NoiseShape::gaussian ? collect_squares
                                                                         : collect_variance;
  collect(view, table.vertical.data(), rows, row_terms(common, fits).data(), columns);
  make_wide_logarithms(result.sum_log_scale, scale_exponent,
                       static_cast<double>(observation.count) * std::log(scales.unit));
  if (view.rule.per_student > 0.0) make_wide_logarithms(result.sum_log_student, student_exponent, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.scale_square[i] = fits[i].square;
    result.sum_log_scale[i] += fits[i].log_width;
  }
  return result;
}

RowStatistics row_statistics(const LevelPlaces& places) {
  const Observation& observation = places.row.observation();
  const ScaleFit fit = scale_fit(places, 1.0);
  const SumRule rule = rule_of(observation, 1.0);
  RowSums sums;
  (observation.noise.shape == NoiseShape::gaussian ? collect_squares_of_one : collect_one)(
      places, {0.0, fit.factor, fit.variance}, rule, &sums);
  return {
      sums.sum_absolute,          sums.sum_square, sums.largest, logarithm_of(sums.scales) + fit.log_width,
      logarithm_of(sums.student), fit.square};
}

}  // namespace voussoir
