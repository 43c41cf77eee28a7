#pragma once
/// @file Unknowns that are no damage: the overall scale of the response, and the datum and tilt of the
/// levelling.

#include <vector>

#include "database/records/database.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// Readings are c d_i + b + t (x_i - x_mean) + noise with c ~ N(1, scale^2), b ~ N(0, datum^2), t ~ N(0,
/// tilt^2); zero: known to be absent. The noise is Gaussian, its relative part counted on the displacement
/// times the scale c that fits the scene best.
struct Nuisance {
  double scale = 0.0;  ///< [-] standard deviation of the factor on all displacements (joint stiffness)
  double datum = 0.0;  ///< [m] of a common shift
  double tilt = 0.0;   ///< [-] of a common rotation (metres per metre)

  bool any() const { return scale > 0.0 || datum > 0.0 || tilt > 0.0; }
};

/// As log_evidence_of_rows, for Gaussian noise, with the nuisances marginalised in closed form (they are
/// linear and Gaussian) and an unknown noise level by quadrature. Rows not given, and impossible scenes, have
/// -infinity. Throws InputError unless the noise is Gaussian, and if its level is unknown beside absolute
/// errors.
std::vector<double> log_evidence_with_nuisance(const Observation& observation, const SceneTable& table,
                                               std::span<const std::size_t> rows,
                                               const std::vector<StoredPoint>& points,
                                               const Nuisance& nuisance);

}  // namespace voussoir
