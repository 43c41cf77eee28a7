#pragma once
/// @file How long a time step may be, and the natural motion of a bridge that damping and moments are
/// measured by.

#include "core/motion/block_dynamics.h"
#include "core/statics/equilibrium.h"

namespace voussoir {

/// How block elasticity is stepped.
enum class Integrator {
  implicit_blocks,     ///< block by block implicitly (block_dynamics.h); the joints alone limit the step
  central_differences  ///< all forces explicitly: the plain reference, with steps a few hundred times shorter
};

/// Longest stable step [s]: 2 / omega with the highest frequency omega of the bridge with all joints closed
/// and sticking, found by power iteration. Joints that see the places a time `contact_damping` [s] later act
/// on a step dt like joints 1 + 2 contact_damping / dt times as stiff.
/// `still`: blocks that do not move; empty: all do.
double critical_step(const Model& model, const std::vector<BlockBody>& bodies, Integrator integrator,
                     double contact_damping, const std::vector<bool>& still = {});

/// The highest frequency of each block alone [rad/s], its joints closed and sticking and its neighbours
/// standing still; blocks respond as in implicit steps of this length [s] (alternating_response).
std::vector<double> block_frequencies(const Model& model, const std::vector<BlockBody>& bodies, double step);

/// The linear bridge, all joints closed and sticking, under its weight.
struct NaturalMotion {
  double frequency;  ///< the lowest, by inverse iteration [rad/s]
  double sag;   ///< largest displacement under the weight, or what a block sinks that two neighbours hold by
                ///< shear alone if that is more (joints that are very soft in shear) [m]
  double work;  ///< half the work of the weight on the displacement [J]
};

/// `system`: of the model's structure.
NaturalMotion natural_motion(const Model& model, const EquilibriumSystem& system);

}  // namespace voussoir
