#pragma once
/// @file Load cases after a first stage: what must come out whatever the bridge, and what remains.

#include "core/structure/model.h"
#include "core/structure/stage.h"

namespace voussoir::validation {

/// A wall of three courses of 4 m in running bond, which slides on its base and along its left side without
/// friction, and whose blocks do not slip on each other.
Model rough_wall();

/// Forces that a pressure [Pa] on the vertical edges at x [m] gives the nodes, towards -x [N]: a dead load.
Field side_pressure(const Model& bridge, double x, double pressure);

/// A vertical force on a node, downwards [N].
Field point_load(const Model& bridge, NodeId node, double force);

/// Maxwell: u_i(F_j) = u_j(F_i) where nothing slips. Largest difference over the largest displacement, among
/// these displacement components (2 node + axis); by central differences of a force [N] on top of `first`.
double reciprocity_error(const Model& bridge, const Stage& first, const std::vector<int>& components,
                         double force);

/// What a load does to a bridge, and what of it is left when the load has gone [m]: largest displacements.
struct LoadTrace {
  double under_load = 0.0;
  double left = 0.0;
};

/// The load after `first` in so many implicit steps, then unloading in as many. Throws std::runtime_error if
/// the bridge does not stand throughout.
LoadTrace load_trace(const Model& bridge, const Stage& first, const Field& load, int steps = 1);

}  // namespace voussoir::validation
