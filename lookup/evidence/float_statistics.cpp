#include "lookup/evidence/float_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/simd/lane_math.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

constexpr float kLog2 = 0.69314718F;

/// The arrays of an Observation and its scales in single precision.
struct FloatView {
  std::vector<float> reading, slope, offset;
};

/// Where the statistics of a row go, with the product of scales in place of the sum of their logarithms.
struct Columns {
  float* sum_absolute;
  float* sum_square;
  float* largest;
  double* product;
};

/// Running statistics of one row or cluster.
struct FloatSums {
  FloatLanes absolute{}, square{}, largest{};
  FloatLanes product = FloatLanes{} + 1.0F;
};

/// Adds the readings of some places: how far they are from the displacements, over the scale of their errors
/// there; the product takes the scale for `least_scale`.
VOUSSOIR_INLINE void add(const FloatLanes& reading, const FloatLanes& error, const FloatLanes& scale,
                         const FloatLanes& least_scale, float inverse_unit, FloatSums& sums) {
  const FloatMask has_reading = reading == reading;
  const FloatLanes z = has_reading ? error / scale : FloatLanes{};
  sums.absolute += z;
  sums.square += z * z;
  sums.largest = z > sums.largest ? z : sums.largest;
  sums.product *= has_reading ? least_scale * inverse_unit : FloatLanes{} + 1.0F;
}

VOUSSOIR_INLINE void store(const FloatSums& sums, std::size_t i, const Columns& columns) {
  float most = 0.0F;
  double all = 1.0;
  for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
    most = std::max(most, sums.largest[lane]);
    all *= static_cast<double>(sums.product[lane]);
  }
  columns.sum_absolute[i] = sum_of(sums.absolute);
  columns.sum_square[i] = sum_of(sums.square);
  columns.largest[i] = most;
  columns.product[i] = all;
}

VOUSSOIR_INLINE void collect_row(const FloatView& view, float inverse_unit, const double* row,
                                 std::size_t i_row, const Columns& columns) {
  FloatSums sums;
  for (std::size_t i = 0; i < view.reading.size(); i += kFloatLanes) {
    const auto reading = load<FloatLanes>(view.reading.data() + i), predicted = load<FloatLanes>(row + i);
    const FloatLanes scale = noise_scale(load<FloatLanes>(view.slope.data() + i),
                                         load<FloatLanes>(view.offset.data() + i), magnitude(predicted));
    add(reading, magnitude(reading - predicted), scale, scale, inverse_unit, sums);
  }
  store(sums, i_row, columns);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect(const FloatView& view, float inverse_unit, const double* table, const std::size_t* rows,
             std::size_t count, std::size_t stride, const Columns& columns) {
  for (std::size_t i = 0; i < count; ++i)
    collect_row(view, inverse_unit, table + rows[i] * stride, i, columns);
}

/// Errors against the nearest place of a cluster's box; scales at its farthest from zero for them, at its
/// nearest to zero for the product.
VOUSSOIR_FOR_EVERY_PROCESSOR
void collect_boxes(const FloatView& view, float inverse_unit, const std::int16_t* least,
                   const std::int16_t* most, const float* units, std::size_t count, const Columns& columns) {
  const std::size_t places = view.reading.size();
  const FloatLanes zero{};
  for (std::size_t cluster = 0; cluster < count; ++cluster) {
    FloatSums sums;
    for (std::size_t i = 0; i < places; i += kFloatLanes) {
      const auto reading = load<FloatLanes>(view.reading.data() + i);
      const auto slope = load<FloatLanes>(view.slope.data() + i);
      const auto offset = load<FloatLanes>(view.offset.data() + i);
      const FloatLanes low = load<FloatLanes>(least + cluster * places + i) * units[cluster];
      const FloatLanes high = load<FloatLanes>(most + cluster * places + i) * units[cluster];
      FloatLanes error = low - reading > reading - high ? low - reading : reading - high;
      error = error > zero ? error : zero;
      const FloatLanes farthest = -low > high ? -low : high;
      FloatLanes nearest = low > -high ? low : -high;
      nearest = nearest > zero ? nearest : zero;
      add(reading, error, noise_scale(slope, offset, farthest), noise_scale(slope, offset, nearest),
          inverse_unit, sums);
    }
    store(sums, cluster, columns);
  }
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void make_logs(float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kFloatLanes) {
    const std::size_t size = std::min(kFloatLanes, count - i);
    auto lanes = load_some<FloatLanes>(values + i, size, 0.0F);
    make_approximate_logarithm(lanes);
    store_some(lanes, size, values + i);
  }
}

std::vector<float> padded(const std::vector<double>& values, std::size_t stride, float filling) {
  std::vector<float> result(values.begin(), values.end());
  result.resize(stride, filling);
  return result;
}

FloatView view_of(const Observation& observation, const ErrorScales& scales, std::size_t stride) {
  return {padded(observation.reading, stride, std::numeric_limits<float>::quiet_NaN()),
          padded(scales.slope, stride, 0.0F), padded(scales.offset, stride, 1.0F)};
}

/// Logarithms of products of any size, -infinity for those out of range.
std::vector<float> logs_of(const std::vector<double>& products, float shift) {
  std::vector<float> mantissa(products.size()), exponent(products.size());
  for (std::size_t i = 0; i < products.size(); ++i) {
    const auto bits = std::bit_cast<std::int64_t>(products[i]);
    const std::int64_t e = ((bits >> 52) & 0x7FF) - 1023;
    mantissa[i] = static_cast<float>(std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFF) | 0x3FF0000000000000));
    const bool in_range = e > -1023 && e < 1024;
    exponent[i] = in_range ? static_cast<float>(e) * kLog2 + shift : -std::numeric_limits<float>::infinity();
  }
  make_logs(mantissa.data(), mantissa.size());
  for (std::size_t i = 0; i < products.size(); ++i) exponent[i] += mantissa[i];
  return exponent;
}

/// What `run` collects for so many rows, from `count` readings.
template <typename Run>
FloatStatistics collected(std::size_t count, double unit, std::size_t rows, Run run) {
  const std::vector<float> zeros(rows, 0.0F);
  FloatStatistics result{zeros, zeros, zeros, {}};
  std::vector<double> products(rows);
  run(static_cast<float>(1.0 / unit),
      Columns{result.sum_absolute.data(), result.sum_square.data(), result.largest.data(), products.data()});
  result.log_scale = logs_of(products, static_cast<float>(static_cast<double>(count) * std::log(unit)));
  return result;
}

}  // namespace

FloatStatistics float_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SceneTable& table, std::span<const std::size_t> rows) {
  const std::size_t stride = (table.points + kFloatLanes - 1) / kFloatLanes * kFloatLanes;
  const FloatView view = view_of(observation, scales, stride);
  // Whole registers are read; where that would go beyond the table, from a copy that is long enough.
  std::size_t inside = rows.size();
  while (inside > 0 && rows[inside - 1] * table.points + stride > table.vertical.size()) --inside;
  return collected(
      observation.count, scales.unit, rows.size(), [&](float inverse_unit, const Columns& columns) {
        collect(view, inverse_unit, table.vertical.data(), rows.data(), inside, table.points, columns);
        std::vector<double> copy(stride, 0.0);
        for (std::size_t i = inside; i < rows.size(); ++i) {
          std::copy_n(table.row(rows[i]).begin(), table.points, copy.begin());
          collect_row(view, inverse_unit, copy.data(), i, columns);
        }
      });
}

FloatStatistics least_statistics(const Observation& observation, const ErrorScales& scales,
                                 const SearchIndex& index) {
  const FloatView view = view_of(observation, scales, index.places);
  std::vector<float> units;
  for (const std::int32_t exponent : index.exponent) units.push_back(std::ldexp(1.0F, exponent));
  return collected(observation.count, scales.unit, index.clusters(),
                   [&](float inverse_unit, const Columns& columns) {
                     collect_boxes(view, inverse_unit, index.least.data(), index.most.data(), units.data(),
                                   index.clusters(), columns);
                   });
}

}  // namespace voussoir
