#pragma once
/// @file Symmetric matrices, of which the lower triangle is kept.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace voussoir {

/// A symmetric matrix: row i of its lower triangle begins at place i (i + 1) / 2.
using LowerTriangle = std::vector<double>;

constexpr std::size_t lower_size(std::size_t n) {
  return n * (n + 1) / 2;
}

LowerTriangle lower_of(const Eigen::MatrixXd& matrix);
/// The other way; above the diagonal are zeros.
Eigen::MatrixXd matrix_of(const LowerTriangle& lower, Eigen::Index rows);

}  // namespace voussoir
