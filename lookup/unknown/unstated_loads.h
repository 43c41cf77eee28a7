#pragma once
/// @file Loads that stood on the bridge at one of the levellings, of which nobody says anything: a lorry.

#include <span>
#include <vector>

#include "lookup/unknown/unstated_cause.h"

namespace voussoir {

/// [N/m] Standard deviation of the force on half a metre of the top, for each metre of the width: of a lorry
/// of 16 t, 3 m wide, 53e3 stand on two axles.
inline constexpr double kUnstatedForce = 20e3;

/// A load on one stretch of the top, at one of the levellings.
struct UnstatedLoad {
  double from = 0.0, to = 0.0;  ///< [m] x of the stretch
  bool first_epoch = false;     ///< it stood there at the first of two times, not at the second or only one
  double force = 0.0;   ///< [N/m] its most likely sum with no block missing, of each metre of the width
  UnstatedCause cause;  ///< with errors of the first order
};

/// The stretches on which a load explains readings of the intact bridge best, the best first. Loads
/// act downwards as a whole. Nothing if the database does not know what loads do, or readings are what other
/// loads add.
std::vector<UnstatedLoad> unstated_loads(const UnknownBridge& bridge,
                                         std::span<const IntactGaussian> gaussians, std::size_t count);

}  // namespace voussoir
