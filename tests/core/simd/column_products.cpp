/// @file Products of columns. Oracle: Eigen's products of whole matrices.

#include "core/simd/column_products.h"

#include <catch2/catch.hpp>

using namespace voussoir;
using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr double kRounding = 1e-13;  // of sums of a hundred numbers near one

bool lower_agrees(const LowerTriangle& lower, const MatrixXd& wanted) {
  const MatrixXd all = wanted.triangularView<Eigen::Lower>();
  return (matrix_of(lower, wanted.rows()) - all).cwiseAbs().maxCoeff() < kRounding;
}

}  // namespace

TEST_CASE("The lower triangle of a product of columns is that of Eigen's product") {
  const Index rows = GENERATE(1, 3, 8, 13, 78), columns = GENERATE(0, 1, 5, 72);
  const MatrixXd a = MatrixXd::Random(rows, columns), b = MatrixXd::Random(rows, columns);
  CHECK(lower_agrees(outer_product(a), a * a.transpose()));
  LowerTriangle sum(lower_size(static_cast<std::size_t>(rows)), 0.25);
  add_lower_product(filled_up(a), filled_up(b), static_cast<std::size_t>(rows), -0.5, sum);
  CHECK(lower_agrees(sum, MatrixXd::Constant(rows, rows, 0.25) - 0.5 * a * b.transpose()));
}

TEST_CASE("Columns in directions are Eigen's product, however many there are") {
  const Index channels = GENERATE(1, 7, 80), columns = GENERATE(1, 4, 9), stride = GENERATE(8, 32);
  const MatrixXd directions = MatrixXd::Random(stride, channels),
                 values = MatrixXd::Random(channels, columns);
  MatrixXd projected = MatrixXd::Constant(stride, columns, 7.0);
  project_columns(directions.data(), static_cast<std::size_t>(channels), values.data(),
                  static_cast<std::size_t>(columns), static_cast<std::size_t>(stride), projected.data());
  CHECK((projected - directions * values).cwiseAbs().maxCoeff() < kRounding);
}
