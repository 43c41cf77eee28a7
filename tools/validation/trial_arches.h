#pragma once
/// @file Arches of mean radius 1 m on clamped stones, as the validation loads and moves them: what describes
/// them, the rigid voussoirs alone, and the bridge with elastic joints.

#include "core/structure/model.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/rigid_arch.h"

namespace voussoir::validation {

/// The segment of a ring of mean radius 1 m that reaches `half_angle` to both sides of the crown.
SpanDescription segmental(double half_angle, double thickness, int voussoirs);

/// Two arcs of mean radius 1 m with their centres `beyond` [m] past the axis, on the springing line.
SpanDescription pointed(double beyond, double thickness, int voussoirs);

/// The voussoirs alone, rigid, about x = 0.
RigidArch rigid(const SpanDescription& span);

/// The same with elastic joints, on clamped stones: block 0, the voussoirs from the left, the last block.
Model elastic(const SpanDescription& span, double normal_stiffness);

}  // namespace voussoir::validation
