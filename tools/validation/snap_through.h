#pragma once
/// @file Rigid voussoirs on elastic joints in the deformed geometry: an independent answer to what force the
/// joints' give leaves of what a rigid ring bears.

#include "tools/validation/rigid_arch.h"

namespace voussoir::validation {

/// Of dry joints: pressure where the faces overlap, shear up to Coulomb's bound.
struct ElasticJoints {
  double stiffness;  ///< pressure per overlap, and shear per slip [1/m; Pa/m over the weight of 1 m3]
  double friction;   ///< tangent of the angle
};

/// The greatest vertical force downwards at `place` on voussoir `loaded` [N/m of depth over the weight of
/// 1 m2]: voussoir `loaded` is lowered step by step until the force falls. The voussoirs have three
/// unknowns each, in any turn. Precondition: the loaded voussoir sinks steadily up to that force, and the
/// arch stands under its weight. Throws Failure if an equilibrium on the way is not found.
double snap_through_force(const RigidArch& arch, int loaded, const Point& place, const ElasticJoints& joints);

}  // namespace voussoir::validation
