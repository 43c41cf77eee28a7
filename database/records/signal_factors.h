#pragma once
/// @file What a loss changes in the derivatives, D = A - A_intact (points x columns of the basis), by itself:
/// D = B W^T with orthonormal columns in W, which nobody needs to know:
///
///   D D^T = B B^T,   A_intact D^T = H B^T,   H = A_intact W.
///
/// Of 78 points and 361 columns B and H are a fifth of D, and their leading columns hold nearly all. Beside
/// them the leading columns of D itself are needed, for what the losses of several blocks have in common.

#include <Eigen/Core>

namespace voussoir {

/// Columns of the basis that count as they are when two blocks are gone. What the others give one block's
/// signal and another's counts as independent: measured on 300 pairs of the reference bridge, that leaves out
/// 0.2 % of what the signals have in common (median; at most 7 %, of neighbours).
inline constexpr Eigen::Index kLeadingColumns = 64;

struct SignalFactors {
  Eigen::MatrixXd own;     ///< B [m]: points x columns, the largest variance that is left first
  Eigen::MatrixXd intact;  ///< H [m]: the same shape
};

/// X X^T.
Eigen::MatrixXd product_with_itself(const Eigen::MatrixXd& columns);

/// Whether factors have the products that they are kept for, but for what may be left.
bool are_signal_factors(const SignalFactors& factors, const Eigen::MatrixXd& intact,
                        const Eigen::MatrixXd& change);

/// By Cholesky's factorisation of D D^T, the largest diagonal first, until 1e-10 m are left at each point.
SignalFactors signal_factors(const Eigen::MatrixXd& intact, const Eigen::MatrixXd& change);

}  // namespace voussoir
