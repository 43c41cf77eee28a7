#pragma once
/// @file Direct solution of several sparse systems of one pattern side by side, a scene a SIMD lane.

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "core/simd/lanes.h"

namespace voussoir {

/// LU factorisation without pivoting of matrices with one structurally symmetric pattern (stiffness matrices
/// with friction: symmetric in structure, not in value), after a fill-reducing ordering (AMD). All scenes of
/// a bridge share the pattern, so the index arithmetic is done once for all lanes; neighbouring columns of
/// equal structure form supernodes, so that a row is loaded once for several columns. Lanes do not influence
/// each other.
class LaneFactorisation {
 public:
  explicit LaneFactorisation(const Eigen::SparseMatrix<double>& pattern);

  /// Factorises the matrices whose values, in the pattern's order, stand in the lanes. Per lane: false if a
  /// pivot lost all its digits (the matrix is singular or needs pivoting); that lane's solution is then of no
  /// use.
  std::array<bool, kLanes> factorise(const LaneVector& values);

  /// Replaces the right-hand sides by the solutions.
  void solve(LaneVector& right_hand_side);

 private:
  /// Columns first .. first + width - 1 of L, equal in structure below the last of them.
  struct Supernode {
    int first;
    int width;
    int rows;    ///< begin in row_ of the rows below the supernode
    int height;  ///< how many
    int values;  ///< begin in l_ and, transposed, in u_: `width` rows of the diagonal block, then `height`
                 ///< rows, each of `width` values
  };
  /// Part of a column of U: the rows of a supernode.
  struct UpperPart {
    int supernode;
    int values;  ///< begin in u_
  };
  struct Kernel;

  void order(const Eigen::SparseMatrix<double>& pattern);
  std::vector<std::vector<int>> find_fill(const Eigen::SparseMatrix<double>& pattern);
  void form_supernodes(const std::vector<std::vector<int>>& lower);
  void form_upper_parts();

  int n_;
  std::vector<int> permutation_;  ///< new position -> old
  std::vector<int> position_;     ///< old -> new position
  std::vector<int> a_begin_;      ///< per permuted column: its entries of the matrix ..
  std::vector<int> a_row_;        ///< .. permuted row
  std::vector<int> a_slot_;       ///< .. and place in the value array
  std::vector<Supernode> supernodes_;
  std::vector<int> supernode_of_;  ///< per column
  std::vector<int> row_;
  std::vector<int> upper_begin_;  ///< per column: its parts of U
  std::vector<UpperPart> upper_;
  LaneVector l_, u_, pivot_, diagonal_, work_;
};

}  // namespace voussoir
