#pragma once
/// @file The density of readings that are exactly what is expected: the most that a covariance allows.

#include <Eigen/Core>

#include "lookup/unknown/scatter_density.h"

namespace voussoir {

/// log density of no difference at all under noise + kappa bridge.
ScatterLogs log_peak(const Eigen::MatrixXd& noise, const Eigen::MatrixXd& bridge);

/// What the density of all rows (`peaks`) has more than that of the first few directions, which goes without
/// its powers of two pi.
ScatterLogs log_outside(const ScatterLogs& peaks, const Eigen::MatrixXd& noise, const Eigen::MatrixXd& bridge,
                        std::size_t directions);

}  // namespace voussoir
