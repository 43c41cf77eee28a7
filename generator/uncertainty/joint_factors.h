#pragma once
/// @file Columns that have the covariance of errors in several states of the same bridges.

#include <Eigen/Core>
#include <vector>

namespace voussoir {

/// Of one state: the error of each bridge's readings; empty where the bridge does not stand.
using StateErrors = std::vector<Eigen::VectorXd>;

/// F of each state, with as many columns in all, so that F_s F_t^T are the second moments of the errors in
/// states s and t: what a load adds is off by F_s - F_t. Each state counts the bridges that stand in it; of
/// two states with other bridges what both have in common is understated. A column of zeros if nothing
/// stands. `errors`: by state, each of as many bridges.
std::vector<Eigen::MatrixXd> joint_factors(const std::vector<StateErrors>& errors, Eigen::Index points);

}  // namespace voussoir
