#include "lookup/evidence/row_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/simd/lane_math.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kSafeProducts = 16;  // factors within 1e+-19 of the unit cannot leave a double's range

/// Running statistics, lane by lane, with the product of scales in place of the sum of their logarithms.
struct LaneStatistics {
  DoubleLanes sum_absolute{}, sum_square{}, largest{};
  DoubleLanes product = DoubleLanes{} + 1.0;
};

/// The arrays of an Observation and its scales, as the loop below wants them.
struct View {
  const double* reading;
  const double* slope;
  const double* offset;
  const double* intact;
  double model_error;
  double inverse_unit;
  std::size_t points;
};

VOUSSOIR_INLINE void add_errors(const View& view, std::size_t i, std::size_t count, const double* prediction,
                                LaneStatistics& statistics) {
  const auto at = [&](const double* values) __attribute__((always_inline)) {
    return load_some<DoubleLanes>(values + i, count, kNan);
  };
  const DoubleLanes reading = at(view.reading),
                    predicted = load_some<DoubleLanes>(prediction + i, count, kNan);
  const DoubleLanes slope = at(view.slope), offset = at(view.offset), movement = magnitude(predicted);
  const DoubleLanes scale = view.model_error > 0.0 ? noise_scale(slope, offset, movement, view.model_error,
                                                                 magnitude(at(view.intact) - predicted))
                                                   : noise_scale(slope, offset, movement);
  const DoubleMask has_reading = reading == reading;
  const DoubleLanes z = has_reading ? magnitude(reading - predicted) / scale : DoubleLanes{};
  statistics.sum_absolute += z;
  statistics.sum_square += z * z;
  statistics.largest = z > statistics.largest ? z : statistics.largest;
  statistics.product *= has_reading ? scale * view.inverse_unit : DoubleLanes{} + 1.0;
}

/// A positive number as mantissa times two to the power of the exponent: products of any length keep their
/// range.
struct WideProduct {
  double mantissa = 1.0;
  double exponent = 0.0;
};

/// Multiplies the lanes' products into the wide one and starts the lanes anew.
VOUSSOIR_INLINE void flush(DoubleLanes& product, WideProduct& wide) {
  constexpr std::int64_t kMantissaBits = 0x000FFFFFFFFFFFFF;
  constexpr std::int64_t kOneBits = 0x3FF0000000000000;
  const DoubleMask bits = reinterpret_cast<DoubleMask>(product);
  const DoubleMask exponents = (bits >> 52) - 1023;
  const DoubleLanes mantissas = reinterpret_cast<DoubleLanes>((bits & kMantissaBits) | kOneBits);
  wide.mantissa *= (mantissas[0] * mantissas[1]) * (mantissas[2] * mantissas[3]);
  wide.exponent += static_cast<double>((exponents[0] + exponents[1]) + (exponents[2] + exponents[3]));
  product = DoubleLanes{} + 1.0;
}

/// Where the statistics go; the logarithms are taken of all rows at once, later.
struct Columns {
  double* sum_absolute;
  double* sum_square;
  double* largest;
  double* mantissa;
  double* exponent;
};

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect(const View& view, const double* table, std::size_t rows, const Columns& columns) {
  for (std::size_t row = 0; row < rows; ++row) {
    const double* const prediction = table + row * view.points;
    LaneStatistics lanes;
    WideProduct product;
    std::size_t i = 0;
    for (std::size_t step = 1; i + kLanes <= view.points; i += kLanes, ++step) {
      add_errors(view, i, kLanes, prediction, lanes);
      if (step % kSafeProducts == 0) flush(lanes.product, product);
    }
    if (i < view.points) add_errors(view, i, view.points - i, prediction, lanes);
    flush(lanes.product, product);
    columns.sum_absolute[row] = sum_of(lanes.sum_absolute);
    columns.sum_square[row] = sum_of(lanes.sum_square);
    columns.largest[row] = largest_of(lanes.largest);
    columns.mantissa[row] = product.mantissa;
    columns.exponent[row] = product.exponent;
  }
}

}  // namespace

TableStatistics table_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table) {
  const std::vector<double> zeros(table.rows, 0.0);
  TableStatistics result{zeros, zeros, zeros, zeros};
  std::vector<double> exponent = zeros;
  const View view{
      observation.reading.data(),    scales.slope.data(), scales.offset.data(), observation.intact.data(),
      observation.noise.model_error, 1.0 / scales.unit,   table.points};
  collect(view, table.vertical.data(), table.rows,
          {result.sum_absolute.data(), result.sum_square.data(), result.largest.data(),
           result.sum_log_scale.data(), exponent.data()});
  make_logarithms(result.sum_log_scale);
  const double shift = static_cast<double>(observation.count) * std::log(scales.unit);
  for (std::size_t row = 0; row < table.rows; ++row)
    result.sum_log_scale[row] += exponent[row] * std::numbers::ln2 + shift;
  return result;
}

std::vector<double> standard_errors(const Observation& observation, const ErrorScales& scales,
                                    std::span<const double> prediction) {
  std::vector<double> result = error_scales(observation, scales, prediction);
  for (std::size_t i = 0; i < prediction.size(); ++i)
    result[i] = (observation.reading[i] - prediction[i]) / result[i];
  return result;
}

}  // namespace voussoir
