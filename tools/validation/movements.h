#pragma once
/// @file A structure while its supports are moved: force against displacement, and the states on the way.

#include <vector>

#include "core/structure/model.h"
#include "tools/validation/path.h"

namespace voussoir::validation {

/// The end of a step.
struct MovedPoint {
  std::size_t movement = 0;  ///< its number in the list
  Point moved;               ///< [m] of the movement's support since the start of all
  Point force;               ///< [N] with which that support acts on the structure
  PathPoint at;
};

struct MovedStructure {
  std::vector<MovedPoint> points;
  bool complete = false;  ///< false: no equilibrium was found beyond the last point
};

/// Gravity first, all supports where they are; then the movements one after the other. A pressure is reached
/// by moving the support until its mean over the top is met to a millionth. Throws InputError if a movement's
/// support does not exist or if gravity or a pressure finds no equilibrium.
MovedStructure follow_movements(const Model& model, const std::vector<MovementDescription>& movements,
                                const PathSettings& settings = {});

}  // namespace voussoir::validation
