#pragma once
/// @file Products of columns of numbers, in plain arithmetic: the same bits on every processor.

#include <Eigen/Core>
#include <cstddef>

#include "core/simd/lower_triangle.h"

namespace voussoir {

/// Columns of products are `stride` numbers long, a multiple of this, and read to their ends.
inline constexpr std::size_t kColumnUnit = 8;

/// Sums over channels: `by_channel` has `stride` numbers for each channel, a column of the result as many,
/// and `columns` one for each channel, one column after the other.
void project_columns(const double* by_channel, std::size_t channels, const double* columns, std::size_t count,
                     std::size_t stride, double* projected);

/// Of a lower triangle.
struct LowerRows {
  std::size_t begin, end;
};

/// Adds factor A B^T to these rows of a lower triangle (LowerTriangle); `count` columns in A and B.
void add_lower_product(const double* a, const double* b, std::size_t stride, std::size_t count,
                       LowerRows rows, double factor, double* lower);

/// Columns filled up with zeros to a multiple of kColumnUnit.
Eigen::MatrixXd filled_up(const Eigen::MatrixXd& columns);

/// Adds factor A B^T of the first rows of filled up columns.
void add_lower_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, std::size_t rows, double factor,
                       LowerTriangle& lower);

/// A A^T.
LowerTriangle outer_product(const Eigen::MatrixXd& columns);

}  // namespace voussoir
