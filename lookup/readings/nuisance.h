#pragma once
/// @file Unknowns that are no damage: the overall scale of the response, and the datum and tilt of every
/// levelling.

#include <Eigen/Core>

#include "lookup/readings/comparison.h"

namespace voussoir {

/// Readings are c d_i + b + t (x_i - x_mean) + noise with c ~ N(1, scale^2), b ~ N(0, datum^2), t ~ N(0,
/// tilt^2); zero: known to be absent. Every levelling has a datum and a tilt of its own, so that readings
/// that are differences have the variances of all that they are made of. With a datum or tilt the noise is
/// Gaussian. Where absolute readings are compared with a model that has errors of its own, the common factor
/// counts as known to this at best: by 1 % two programs may differ that are both right, or one mean stiffness
/// of joints from another.
inline constexpr double kLeastUnknownScale = 0.01;

struct Nuisance {
  double scale = 0.0;  ///< [-] standard deviation of the factor on all displacements (joint stiffness)
  double datum = 0.0;  ///< [m] of the shift of one levelling
  double tilt = 0.0;   ///< [-] of its rotation (metres per metre) about the middle of the points read in it

  bool any() const { return scale > 0.0 || datum > 0.0 || tilt > 0.0; }
};

/// The shifts and rotations of all levellings as columns of what they add to the readings `measured`, each
/// times its standard deviation [m]: points x columns, zero where there is no reading.
Eigen::MatrixXd levelling_columns(const Comparison& comparison, const Measurements& measured,
                                  const Nuisance& nuisance);

}  // namespace voussoir
