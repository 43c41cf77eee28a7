#pragma once
/// @file What goes through the joints at an equilibrium: pressure, shear, where faces slide or are apart.

#include <array>
#include <string_view>
#include <vector>

#include "core/statics/equilibrium.h"

namespace voussoir {

enum class JointCondition {
  open,      ///< the faces are apart all along the stretch, and no mortar holds them
  sticking,  ///< friction or mortar holds them, at least on a part of where they touch
  sliding    ///< friction, or mortar, has given way wherever they touch
};

/// "open", "sticking", "sliding"
std::string_view to_string(JointCondition condition);

/// Of one stretch between two blocks that are there. Ends are numbered as the joint's are.
struct JointForces {
  std::size_t joint = 0;             ///< its number in the structure
  std::array<Point, 2> ends;         ///< [m] at rest, on the first block's edge
  std::array<double, 2> gap{};       ///< [m] positive where the faces are apart
  std::array<double, 2> slip{};      ///< [m] of the second face along the joint, from end 0 to end 1
  std::array<double, 2> pressure{};  ///< [Pa]
  double normal = 0.0;               ///< [N] compression through the stretch; negative where mortar pulls
  double shear = 0.0;                ///< [N] with which friction resists the slip, with its sign
  std::array<Point, 2> on_second{};  ///< [N] forces on the second block in the ends: they are equivalent to
                                     ///< the stresses along the stretch
  double closed_share = 0.0;         ///< [-] of the stretch: faces touch, or mortar holds them
  double sliding_share = 0.0;        ///< [-] of the stretch
  JointCondition condition = JointCondition::open;
};

/// Of all joints between blocks that are there. `parameters` are those that the equations' coefficients come
/// from.
std::vector<JointForces> joint_forces(const StageEquations& equations, const Parameters& parameters,
                                      const Field& displacement);

}  // namespace voussoir
