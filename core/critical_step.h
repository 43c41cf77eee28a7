#pragma once
/// @file How long a time step may be, and the natural motion of a bridge that damping and moments are
/// measured by.

#include "core/block_dynamics.h"

namespace voussoir {

/// How block elasticity is stepped.
enum class Integrator {
  implicit_blocks,     ///< block by block implicitly (block_dynamics.h); the joints alone limit the step
  central_differences  ///< all forces explicitly: the plain reference, with steps a few hundred times shorter
};

/// Longest stable step [s]. The highest frequency omega of the bridge with all joints closed and sticking,
/// found by power iteration, gives 2 / omega for central differences; forces that see the joints a time
/// `contact_damping` [s] later shorten it to sqrt(contact_damping^2 + 4 / omega^2) - contact_damping.
double critical_step(const Bridge& bridge, const std::vector<BlockBody>& bodies, Integrator integrator,
                     double contact_damping);

/// The linear bridge, all joints closed and sticking, under its weight.
struct NaturalMotion {
  double frequency;  ///< the lowest, by inverse iteration [rad/s]
  double sag;        ///< largest displacement under the weight [m]
  double work;       ///< half the work of the weight on the displacement [J]
};

NaturalMotion natural_motion(const Bridge& bridge);

}  // namespace voussoir
