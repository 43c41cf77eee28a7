#include "lookup/row_statistics.h"

#include <cmath>
#include <limits>

#include "lookup/lanes.h"

namespace voussoir {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kClamped = 1e-12;          // [m] points that move less are held by a support
constexpr std::size_t kSafeProducts = 16;   // factors within 1e+-19 of the unit cannot leave a double's range

/// Running statistics, lane by lane, with the product of scales in place of the sum of their logarithms.
struct LaneStatistics {
  Lanes sum_absolute{}, sum_square{}, largest{};
  Lanes product = Lanes{} + 1.0;
};

/// The arrays of an Observation, as the loop below wants them.
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
  Lanes reading, predicted, slope, offset;
  if (count == kLanes) {
    load(view.reading + i, reading);
    load(prediction + i, predicted);
    load(view.slope + i, slope);
    load(view.offset + i, offset);
  } else {
    load_some(view.reading + i, count, reading);
    load_some(prediction + i, count, predicted);
    load_some(view.slope + i, count, slope);
    load_some(view.offset + i, count, offset);
  }
  Lanes movement = predicted;
  make_absolute(movement);
  Lanes scale = slope * movement + offset;
  if (view.model_error > 0.0) {
    Lanes change;
    if (count == kLanes)
      load(view.intact + i, change);
    else
      load_some(view.intact + i, count, change);
    change -= predicted;
    make_absolute(change);
    scale += view.model_error * change;
  }
  Lanes error = reading - predicted;
  make_absolute(error);
  const LaneMask has_reading = reading == reading;
  const Lanes z = has_reading ? error / scale : Lanes{};
  statistics.sum_absolute += z;
  statistics.sum_square += z * z;
  statistics.largest = z > statistics.largest ? z : statistics.largest;
  statistics.product *= has_reading ? scale * view.inverse_unit : Lanes{} + 1.0;
}

VOUSSOIR_INLINE double log_product(Lanes& product) {
  double mantissa = 1.0;
  int exponent = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    int part = 0;
    mantissa *= std::frexp(product[lane], &part);
    exponent += part;
  }
  product = Lanes{} + 1.0;
  return std::log(mantissa) + exponent * 0.693147180559945309417;
}

VOUSSOIR_INLINE double sum_of(const Lanes& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

VOUSSOIR_VECTORISED
void collect(const View& view, const double* table, std::size_t rows, RowStatistics* result) {
  for (std::size_t row = 0; row < rows; ++row) {
    const double* const prediction = table + row * view.points;
    LaneStatistics lanes;
    double sum_log = 0.0;
    std::size_t i = 0;
    for (std::size_t step = 1; i + kLanes <= view.points; i += kLanes, ++step) {
      add_errors(view, i, kLanes, prediction, lanes);
      if (step % kSafeProducts == 0) sum_log += log_product(lanes.product);
    }
    if (i < view.points) add_errors(view, i, view.points - i, prediction, lanes);
    sum_log += log_product(lanes.product);
    const Lanes& top = lanes.largest;
    result[row] = {sum_of(lanes.sum_absolute), sum_of(lanes.sum_square),
                   std::max(std::max(top[0], top[1]), std::max(top[2], top[3])), sum_log};
  }
}

}  // namespace

Observation observe(const Measurements& measurements, std::span<const double> intact, const NoiseModel& noise,
                    double level) {
  const std::size_t points = measurements.displacement.size();
  Observation result{std::vector<double>(points, kNan), std::vector<double>(points, 0.0),
                     std::vector<double>(points, 1.0), {intact.begin(), intact.end()}, noise.model_error, 1.0, 0};
  double sum_log_scale = 0.0;
  for (std::size_t i = 0; i < points; ++i) {
    if (std::isnan(measurements.displacement[i]) || std::abs(intact[i]) <= kClamped) continue;
    const bool own = !std::isnan(measurements.sigma[i]);
    result.reading[i] = measurements.displacement[i];
    result.slope[i] = own ? 0.0 : level;
    result.offset[i] = own ? measurements.sigma[i] : noise.floor + level * kSmallestMovement;
    sum_log_scale += std::log(result.slope[i] * std::abs(intact[i]) + result.offset[i]);
    ++result.count;
  }
  if (result.count > 0) result.unit = std::exp(sum_log_scale / static_cast<double>(result.count));
  return result;
}

std::vector<RowStatistics> row_statistics(const Observation& observation, const SceneTable& table) {
  std::vector<RowStatistics> result(table.rows);
  const View view{observation.reading.data(), observation.slope.data(),     observation.offset.data(),
                  observation.intact.data(),  observation.model_error,      1.0 / observation.unit,
                  table.points};
  collect(view, table.vertical.data(), table.rows, result.data());
  const double shift = static_cast<double>(observation.count) * std::log(observation.unit);
  for (RowStatistics& row : result) row.sum_log_scale += shift;
  return result;
}

std::vector<double> standard_errors(const Observation& observation, std::span<const double> prediction) {
  std::vector<double> result(prediction.size(), kNan);
  for (std::size_t i = 0; i < prediction.size(); ++i) {
    const double change = std::abs(prediction[i] - observation.intact[i]);
    const double scale = observation.slope[i] * std::abs(prediction[i]) + observation.offset[i] +
                         (observation.model_error > 0.0 ? observation.model_error * change : 0.0);
    result[i] = (observation.reading[i] - prediction[i]) / scale;
  }
  return result;
}

}  // namespace voussoir
