#pragma once
/// @file Where the factors of matrices of one pattern have their entries, found once for all of them.

#include <Eigen/SparseCore>
#include <vector>

namespace voussoir {

/// Columns first .. first + width - 1 of L, equal in structure below the last of them.
struct Supernode {
  int first;
  int width;   ///< at most 8
  int rows;    ///< begin in SymbolicFactorisation::row of the rows below the supernode
  int height;  ///< how many
  int values;  ///< begin in L and, transposed, in U: `width` rows of the diagonal block, then `height` rows,
               ///< each of `width` values
};

/// Part of a column of U: the rows of a supernode.
struct UpperPart {
  int supernode;
  int values;  ///< begin in U
};

/// Of structurally symmetric matrices, after a fill-reducing ordering (AMD).
struct SymbolicFactorisation {
  int n = 0;
  int values = 0;                ///< how many L and U have
  std::vector<int> permutation;  ///< new position -> old
  std::vector<int> a_begin;      ///< per permuted column: its entries of the matrix ..
  std::vector<int> a_row;        ///< .. permuted row
  std::vector<int> a_slot;       ///< .. and place in the value array
  std::vector<Supernode> supernodes;
  std::vector<int> supernode_of;  ///< per column
  std::vector<int> row;
  std::vector<int> upper_begin;  ///< per column: its parts of U
  std::vector<UpperPart> upper;
};

/// Throws Failure without memory.
SymbolicFactorisation symbolic_factorisation(const Eigen::SparseMatrix<double>& pattern);

}  // namespace voussoir
