#pragma once
/// @file Direct solution of sparse systems of one pattern: of several side by side, a scene a SIMD lane, or
/// of one with many right-hand sides.

#include <Eigen/SparseCore>
#include <array>

#include "core/simd/lanes.h"
#include "core/statics/symbolic_factorisation.h"

namespace voussoir {

/// L without its unit diagonal, U transposed and its pivots; the matrix's own diagonal; a column at work.
template <class Number>
struct Factors {
  Cells<Number> l, u, pivot, diagonal, work;
};

/// LU factorisation without pivoting of matrices with one structurally symmetric pattern (stiffness matrices
/// with friction: symmetric in structure, not in value). All scenes of a bridge share the pattern, so the
/// index arithmetic is done once for all lanes; neighbouring columns of equal structure form supernodes, so
/// that a row is loaded once for several columns. Lanes do not influence each other. An entry is a Number:
/// DoubleLanes, or a double where there is one matrix only.
template <class Number>
class PatternFactorisation {
 public:
  explicit PatternFactorisation(const Eigen::SparseMatrix<double>& pattern);

  /// Factorises the matrices whose values stand in the pattern's order. Per lane: false if a pivot lost all
  /// its digits (the matrix is singular or needs pivoting); that lane's solution is then of no use.
  std::array<bool, kLaneCount<Number>> factorise(const Cells<Number>& values);

  /// Replaces the right-hand sides by the solutions: each with its lane's matrix, or all with the only one.
  void solve(LaneVector& right_hand_sides);

 private:
  SymbolicFactorisation symbolic_;
  Factors<Number> factors_;
  LaneVector sides_;  ///< in the order of elimination
};

using LaneFactorisation = PatternFactorisation<DoubleLanes>;
using SharedFactorisation = PatternFactorisation<double>;

}  // namespace voussoir
