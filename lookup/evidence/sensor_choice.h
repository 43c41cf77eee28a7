#pragma once
/// @file Which sensors help most, one after the other.

#include <cstddef>
#include <vector>

#include "lookup/evidence/unknown_bridge.h"

namespace voussoir {

/// Rows of y, in each turn the one that adds most to the sum over blocks of the distance of their loss's
/// signal s from nothing, root of s^T C^-1 s with the intact bridge's covariance C, as far as it counts: up
/// to `enough` of these standard deviations. At most `count`. A sensor that falls silent adds nothing here.
std::vector<Eigen::Index> rows_that_help(const UnknownBridge& bridge, double enough, std::size_t count);

}  // namespace voussoir
