#include "core/sparse_solver.h"

#include <klu.h>

#include "core/error.h"

namespace voussoir {
namespace {

/// Smallest over largest pivot below which a factorisation with the reference pivots is done again with its
/// own.
constexpr double kPoorPivots = 1e-13;
/// The same for own pivots: below it the matrix counts as singular.
constexpr double kSingular = 1e-17;

}  // namespace

struct SparseSolver::Factors {
  Eigen::SparseMatrix<double> pattern;
  klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* reference = nullptr;  ///< pivots of the reference matrix, values of the last one
  klu_numeric* own = nullptr;        ///< of a matrix that needs its own pivots
  klu_numeric* current = nullptr;

  ~Factors() {
    if (own != nullptr) klu_free_numeric(&own, &common);
    if (reference != nullptr) klu_free_numeric(&reference, &common);
    if (symbolic != nullptr) klu_free_symbolic(&symbolic, &common);
  }
  int* columns() { return pattern.outerIndexPtr(); }
  int* rows() { return pattern.innerIndexPtr(); }
};

SparseSolver::SparseSolver(const Eigen::SparseMatrix<double>& pattern, std::vector<double> values)
    : factors_(std::make_unique<Factors>()) {
  Factors& f = *factors_;
  f.pattern = pattern;
  klu_defaults(&f.common);
  f.common.btf = 0;     // the pattern is structurally symmetric and connected: one block
  f.common.tol = 1e-3;  // stay on the diagonal, which keeps the fill that the ordering foresaw
  f.symbolic = klu_analyze(static_cast<int>(pattern.rows()), f.columns(), f.rows(), &f.common);
  f.reference = klu_factor(f.columns(), f.rows(), values.data(), f.symbolic, &f.common);
  if (f.symbolic == nullptr || f.reference == nullptr || f.common.status != KLU_OK)
    throw Failure("the bridge's stiffness matrix is singular: some block has no support and no joint");
  f.current = f.reference;
}

SparseSolver::~SparseSolver() = default;
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver& SparseSolver::operator=(SparseSolver&&) noexcept = default;

bool SparseSolver::factorise(std::vector<double>& values) {
  Factors& f = *factors_;
  f.current = f.reference;
  if (klu_refactor(f.columns(), f.rows(), values.data(), f.symbolic, f.reference, &f.common) != 0 &&
      f.common.status == KLU_OK && klu_rcond(f.symbolic, f.reference, &f.common) != 0 &&
      f.common.rcond > kPoorPivots)
    return true;
  if (f.own != nullptr) klu_free_numeric(&f.own, &f.common);
  f.own = klu_factor(f.columns(), f.rows(), values.data(), f.symbolic, &f.common);
  f.current = f.own;
  return f.own != nullptr && f.common.status == KLU_OK && klu_rcond(f.symbolic, f.own, &f.common) != 0 &&
         f.common.rcond > kSingular;
}

void SparseSolver::solve(Eigen::VectorXd& right_hand_side) {
  Factors& f = *factors_;
  klu_solve(f.symbolic, f.current, static_cast<int>(f.pattern.rows()), 1, right_hand_side.data(), &f.common);
}

}  // namespace voussoir
