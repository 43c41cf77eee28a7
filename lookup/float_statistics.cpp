#include "lookup/float_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "lookup/float_lanes.h"

namespace voussoir {
namespace {

constexpr float kLog2 = 0.69314718F;

/// The arrays of an Observation in single precision.
struct FloatView {
  std::vector<float> reading, slope, offset;
};

VOUSSOIR_INLINE float logarithm(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - 0x3F3504F3) >> 23;  // x = 2^exponent f with f in [sqrt(1/2), sqrt(2))
  const auto f = std::bit_cast<float>(bits - (exponent << 23));
  const float s = (f - 1.0F) / (f + 1.0F);
  const float q = s * s;
  return static_cast<float>(exponent) * kLog2 + 2.0F * s * (1.0F + q * (1.0F / 3.0F + q * (1.0F / 5.0F)));
}

VOUSSOIR_VECTORISED
void collect(const FloatView& view, float inverse_unit, const float* table, std::size_t rows,
             std::size_t stride, FloatStatistics& result, double* products) {
  for (std::size_t row = 0; row < rows; ++row) {
    FloatLanes sum_absolute{}, sum_square{}, largest{};
    FloatLanes product = FloatLanes{} + 1.0F;
    for (std::size_t i = 0; i < stride; i += kFloatLanes) {
      FloatLanes reading, predicted, slope, offset;
      load(view.reading.data() + i, reading);
      load(table + row * stride + i, predicted);
      load(view.slope.data() + i, slope);
      load(view.offset.data() + i, offset);
      FloatLanes movement = predicted;
      make_absolute(movement);
      const FloatLanes scale = slope * movement + offset;
      FloatLanes error = reading - predicted;
      make_absolute(error);
      const FloatMask has_reading = reading == reading;
      const FloatLanes z = has_reading ? error / scale : FloatLanes{};
      sum_absolute += z;
      sum_square += z * z;
      largest = z > largest ? z : largest;
      product *= has_reading ? scale * inverse_unit : FloatLanes{} + 1.0F;
    }
    float absolute = 0.0F, square = 0.0F, most = 0.0F;
    double all = 1.0;
    for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
      absolute += sum_absolute[lane];
      square += sum_square[lane];
      most = std::max(most, largest[lane]);
      all *= static_cast<double>(product[lane]);
    }
    result.sum_absolute[row] = absolute;
    result.sum_square[row] = square;
    result.largest[row] = most;
    products[row] = all;
  }
}

VOUSSOIR_VECTORISED
void make_logs(float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) values[i] = logarithm(values[i]);
}

std::vector<float> padded(const std::vector<double>& values, std::size_t stride, float filling) {
  std::vector<float> result(values.begin(), values.end());
  result.resize(stride, filling);
  return result;
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
  make_approximate_logs(mantissa);
  for (std::size_t i = 0; i < products.size(); ++i) exponent[i] += mantissa[i];
  return exponent;
}

}  // namespace

FloatStatistics float_statistics(const Observation& observation, const std::vector<float>& vertical,
                                 std::size_t rows, std::size_t stride) {
  const FloatView view{padded(observation.reading, stride, std::numeric_limits<float>::quiet_NaN()),
                       padded(observation.slope, stride, 0.0F), padded(observation.offset, stride, 1.0F)};
  const std::vector<float> zeros(rows, 0.0F);
  FloatStatistics result{zeros, zeros, zeros, {}};
  std::vector<double> products(rows);
  collect(view, static_cast<float>(1.0 / observation.unit), vertical.data(), rows, stride, result,
          products.data());
  result.log_scale = logs_of(
      products, static_cast<float>(static_cast<double>(observation.count) * std::log(observation.unit)));
  return result;
}

float approximate_log(float x) {
  return logarithm(x);
}

void make_approximate_logs(std::vector<float>& values) {
  make_logs(values.data(), values.size());
}

}  // namespace voussoir
