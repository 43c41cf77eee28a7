#include "core/simd/lower_triangle.h"

namespace voussoir {

LowerTriangle lower_of(const Eigen::MatrixXd& matrix) {
  LowerTriangle lower;
  lower.reserve(lower_size(static_cast<std::size_t>(matrix.rows())));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j) lower.push_back(matrix(i, j));
  return lower;
}

Eigen::MatrixXd matrix_of(const LowerTriangle& lower, Eigen::Index rows) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, rows);
  const double* from = lower.data();
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) matrix(i, j) = *from++;
  return matrix;
}

}  // namespace voussoir
