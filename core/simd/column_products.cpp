#include "core/simd/column_products.h"

#include "core/simd/lanes.h"

namespace voussoir {
namespace {

constexpr std::size_t kTogether = 4;  // columns, or rows, whose sums are in registers at a time
static_assert(kColumnUnit == 2 * kLanes);

/// Some columns; where there are fewer, the last one several times.
VOUSSOIR_FOR_EVERY_PROCESSOR
void project_some(const double* by_channel, std::size_t channels, const double* const (&columns)[kTogether],
                  std::size_t stride, double* const (&projected)[kTogether]) {
  for (std::size_t d = 0; d < stride; d += kColumnUnit) {
    DoubleLanes sums[kTogether][2] = {};
    for (std::size_t k = 0; k < channels; ++k) {
      const DoubleLanes low = load<DoubleLanes>(by_channel + k * stride + d),
                        high = load<DoubleLanes>(by_channel + k * stride + d + kLanes);
      for (std::size_t c = 0; c < kTogether; ++c) {
        sums[c][0] += columns[c][k] * low;
        sums[c][1] += columns[c][k] * high;
      }
    }
    for (std::size_t c = 0; c < kTogether; ++c) {
      store_some(sums[c][0], kLanes, projected[c] + d);
      store_some(sums[c][1], kLanes, projected[c] + d + kLanes);
    }
  }
}

/// Rows from i on, in whole registers: what lies right of the diagonal is dropped.
VOUSSOIR_FOR_EVERY_PROCESSOR
void add_rows(const double* a, const double* b, std::size_t stride, std::size_t count, std::size_t i,
              std::size_t rows, double factor, double* lower) {
  for (std::size_t j = 0; j < i + rows; j += kColumnUnit) {
    DoubleLanes sums[kTogether][2] = {};
    for (std::size_t p = 0; p < count; ++p) {
      const double* const own = a + p * stride + i;
      const DoubleLanes low = load<DoubleLanes>(b + p * stride + j),
                        high = load<DoubleLanes>(b + p * stride + j + kLanes);
      for (std::size_t r = 0; r < kTogether; ++r) {
        sums[r][0] += own[r] * low;
        sums[r][1] += own[r] * high;
      }
    }
    for (std::size_t r = 0; r < rows; ++r) {
      double row[kColumnUnit];
      store_some(factor * sums[r][0], kLanes, row);
      store_some(factor * sums[r][1], kLanes, row + kLanes);
      double* const to = lower + lower_size(i + r) + j;
      for (std::size_t k = 0; k < kColumnUnit && j + k <= i + r; ++k) to[k] += row[k];
    }
  }
}

}  // namespace

void project_columns(const double* by_channel, std::size_t channels, const double* columns, std::size_t count,
                     std::size_t stride, double* projected) {
  for (std::size_t first = 0; first < count; first += kTogether) {
    const double* from[kTogether];
    double* to[kTogether];
    for (std::size_t c = 0; c < kTogether; ++c) {
      const std::size_t column = smaller(first + c, count - 1);
      from[c] = columns + column * channels;
      to[c] = projected + column * stride;
    }
    project_some(by_channel, channels, from, stride, to);
  }
}

void add_lower_product(const double* a, const double* b, std::size_t stride, std::size_t count,
                       LowerRows rows, double factor, double* lower) {
  for (std::size_t i = rows.begin; i < rows.end; i += kTogether)
    add_rows(a, b, stride, count, i, smaller(kTogether, rows.end - i), factor, lower);
}

Eigen::MatrixXd filled_up(const Eigen::MatrixXd& columns) {
  const auto rows = static_cast<Eigen::Index>(padded(static_cast<std::size_t>(columns.rows()), kColumnUnit));
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, columns.cols());
  result.topRows(columns.rows()) = columns;
  return result;
}

void add_lower_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, std::size_t rows, double factor,
                       LowerTriangle& lower) {
  add_lower_product(a.data(), b.data(), static_cast<std::size_t>(a.rows()),
                    static_cast<std::size_t>(a.cols()), {0, rows}, factor, lower.data());
}

LowerTriangle outer_product(const Eigen::MatrixXd& columns) {
  const auto rows = static_cast<std::size_t>(columns.rows());
  LowerTriangle lower(lower_size(rows), 0.0);
  const Eigen::MatrixXd filled = filled_up(columns);
  add_lower_product(filled, filled, rows, 1.0, lower);
  return lower;
}

}  // namespace voussoir
