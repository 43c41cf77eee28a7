#pragma once
/// @file One time step.

#include "core/motion/motion.h"

namespace voussoir {

/// Forces at the present places, then the step that they cause (see block_dynamics.h), in every lane.
/// Precondition: motion.pairs holds all edges that may touch. All instruction sets, and all numbers of lanes,
/// give the same bits.
void take_implicit_step(const MotionModel& model, Motion<double>& motion);
void take_implicit_step(const MotionModel& model, Motion<DoubleLanes>& motion);

/// Central differences with lumped masses, every triangle by itself (law/triangle.h). The frames stay at
/// rest.
void take_explicit_step(const MotionModel& model, Motion<double>& motion);

}  // namespace voussoir
