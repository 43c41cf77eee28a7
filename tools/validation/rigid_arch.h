#pragma once
/// @file Limit analysis of an arch of rigid voussoirs of any shape, with friction that prevents sliding: an
/// independent answer to what stands and where it hinges.

#include <array>
#include <optional>
#include <vector>

#include "core/geometry/polygon.h"

namespace voussoir::validation {

/// A joint by its ends.
struct RigidJoint {
  Point inner, outer;
};

/// Voussoirs between joints: voussoir i lies between joints i and i + 1, from the left; the outermost joints
/// are on rigid ground.
struct RigidArch {
  std::vector<RigidJoint> joints;
  std::vector<Polygon> voussoirs;
};

/// Can the thrust pass through all joints, by the safe theorem? The arch is its own mirror image across x = 0
/// and carries its weight: thrust at the crown and its height are the two unknowns, and every joint bounds
/// them by two straight lines.
bool symmetric_arch_stands(const RigidArch& arch);

/// The least of all thrusts that stay within the joints: what an arch comes to when its feet give way
/// (Heyman, The Stone Skeleton, 1995).
struct LeastThrust {
  double thrust = 0.0;       ///< [over the weight of 1 m2]
  int outer = 0, inner = 0;  ///< the joints of the left half on whose outer and inner ends it passes: hinges
};

/// Of an arch that is its own mirror image across x = 0; nothing if it cannot stand.
std::optional<LeastThrust> least_thrust(const RigidArch& arch);

/// A mechanism of four hinges.
struct Mechanism {
  double load = 0.0;            ///< at which it moves [N/m of depth over the weight of 1 m2]
  std::array<int, 4> joints{};  ///< from the left
  bool first_inside = false;    ///< the first hinge is on the intrados; then they alternate
};

/// The least load of all mechanisms, a vertical force downwards at `place` on voussoir `loaded`: all
/// choices of four joints are tried (the kinematic theorem). Nothing if none moves.
std::optional<Mechanism> weakest_mechanism(const RigidArch& arch, int loaded, const Point& place);

}  // namespace voussoir::validation
