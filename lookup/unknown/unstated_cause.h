#pragma once
/// @file Something that may have acted on what the intact bridge shows, and that nobody stated.

#include <span>
#include <vector>

#include "lookup/unknown/intact_gaussian.h"

namespace voussoir {

struct UnstatedCause {
  Eigen::VectorXd expected;    ///< [m] in rows of y: what it most likely adds with no block missing
  Eigen::MatrixXd covariance;  ///< [m2] the same: what it may add
  UnknownCase best;            ///< in which the readings are likeliest
  double log = 0.0;            ///< density of the readings, but for what all cases have in common
};

/// What one cause adds, as a part of the columns of all: N(0, size^2) times each.
struct CauseColumns {
  Eigen::Index first = 0, count = 0;
  double size = 1.0;
};

/// What may have acted when the bridge was read: at the first of two times, or at the second or only one.
struct PossibleCauses {
  Eigen::MatrixXd columns;  ///< channels x columns of all causes, times their sizes [m]
  std::vector<CauseColumns> causes;
};

/// A cause beside the intact bridge.
struct CauseFit {
  std::size_t cause = 0;
  bool first_epoch = false;
  Eigen::VectorXd amounts;  ///< the most likely ones, in sizes
  UnknownCase best;         ///< in which the readings are likeliest
  double log = 0.0;         ///< their density, but for what all cases have in common
};

/// Of each cause at each time that counts by itself.
std::vector<CauseFit> cause_fits(const UnknownBridge& bridge, std::span<const IntactGaussian> gaussians,
                                 const PossibleCauses& possible);

/// [m] By channel, a standard deviation of a cause.
Eigen::MatrixXd channel_columns(const PossibleCauses& possible, std::size_t cause);

UnstatedCause unstated_cause(const UnknownBridge& bridge, const PossibleCauses& possible,
                             const CauseFit& fit);

/// In rows of y, what is added to channels (rows) at one of the times.
Eigen::MatrixXd at_epoch(const UnknownBridge& bridge, const Eigen::MatrixXd& channels, bool first_epoch);

/// Of readings as far from an intact bridge as these, or farther, all that scatters as the bridge file
/// states.
struct CauseChances {
  double with = 0.0;  ///< if the cause acts
  double without = 0.0;
};

/// In the cause's best case.
CauseChances cause_chances(const UnknownBridge& bridge, const Observation& observation,
                           const UnstatedCause& cause);

}  // namespace voussoir
