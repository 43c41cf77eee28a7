#include "database/records/signal_factors.h"

#include <cmath>
#include <vector>

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeft = 1e-20;      // [m2] variance at a point that is not factorised
constexpr double kRounding = 1e-15;  // the same as a share of the largest

double least_variance(const VectorXd& variances) {
  return std::max(kLeft, kRounding * variances.maxCoeff());
}

/// How many times as much may be left of stored factors, which others have rounded.
constexpr double kSlack = 100.0;

}  // namespace

MatrixXd product_with_itself(const MatrixXd& columns) {
  MatrixXd product = MatrixXd::Zero(columns.rows(), columns.rows());
  if (columns.cols() > 0) product.selfadjointView<Eigen::Lower>().rankUpdate(columns);
  product.triangularView<Eigen::StrictlyUpper>() = product.transpose();
  return product;
}

bool are_signal_factors(const SignalFactors& factors, const MatrixXd& intact, const MatrixXd& change) {
  const MatrixXd variance = product_with_itself(change);
  const double left = kSlack * least_variance(variance.diagonal());
  const double across = std::sqrt(left * intact.rowwise().squaredNorm().maxCoeff());
  return (product_with_itself(factors.own) - variance).cwiseAbs().maxCoeff() <= left &&
         (factors.intact * factors.own.transpose() - intact * change.transpose()).cwiseAbs().maxCoeff() <=
             across;
}

SignalFactors signal_factors(const MatrixXd& intact, const MatrixXd& change) {
  const Index points = change.rows();
  const MatrixXd product = product_with_itself(change);
  VectorXd left = product.diagonal();
  const double least = least_variance(left);
  MatrixXd own(points, points);
  std::vector<Index> pivots;
  for (Index k = 0; k < points; ++k) {
    Index pivot = 0;
    const double size = left.maxCoeff(&pivot);
    if (!(size > least)) break;
    own.col(k) =
        (product.col(pivot) - own.leftCols(k) * own.row(pivot).head(k).transpose()) / std::sqrt(size);
    left -= own.col(k).cwiseAbs2();
    left[pivot] = 0.0;
    pivots.push_back(pivot);
  }
  own.conservativeResize(points, static_cast<Index>(pivots.size()));
  // H B^T = A_intact D^T at the pivots' rows, where B is a lower triangle.
  const MatrixXd at_pivots = own(pivots, Eigen::all);
  MatrixXd across = change(pivots, Eigen::all) * intact.transpose();
  at_pivots.triangularView<Eigen::Lower>().solveInPlace(across);
  return {std::move(own), across.transpose()};
}

}  // namespace voussoir
