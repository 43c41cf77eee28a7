#pragma once
/// @file Direct solution of sparse linear systems that share one pattern (SuiteSparse KLU).

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace voussoir {

/// Orders once and chooses pivots once, on a reference matrix; then factorises any number of matrices of that
/// pattern with those pivots, or with new ones where they are no good. The result depends on the matrix
/// alone, not on those factorised before.
class SparseSolver {
 public:
  /// `values` of the reference matrix, in the order of the compressed pattern. Throws Failure if it is
  /// singular.
  SparseSolver(const Eigen::SparseMatrix<double>& pattern, std::vector<double> values);
  ~SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  SparseSolver& operator=(SparseSolver&&) noexcept;

  /// Factorises the matrix with these values. False if it is singular to working precision.
  bool factorise(std::vector<double>& values);

  /// Replaces the right-hand side by the solution. Precondition: the last `factorise` returned true.
  void solve(Eigen::VectorXd& right_hand_side);

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace voussoir
