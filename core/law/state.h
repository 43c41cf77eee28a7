#pragma once
/// @file What a stage leaves behind, and the next one starts from.

#include <Eigen/Core>
#include <vector>

#include "core/structure/mesh.h"

namespace voussoir {

/// What a point of a joint with mortar remembers (cohesive_law.h).
struct BondMemory {
  double plastic_slip = 0.0;  ///< s_p [m]
  double opening = 0.0;       ///< w, the largest inelastic one [m]
  double slipped = 0.0;       ///< kappa, length of all plastic slip that wore the bond [m]
  double crushed = 0.0;       ///< by how much the joint has become thinner [m]
  friend bool operator==(const BondMemory&, const BondMemory&) = default;
};

/// Plastic slip of a dry joint at the two ends of its stretch [m]: what friction has given way by. Linear in
/// between. Of a joint with mortar its points instead.
struct JointMemory {
  double slip_0 = 0.0;
  double slip_1 = 0.0;
  std::vector<BondMemory> bond{};  ///< at bond_points(); empty: no mortar, or nothing has happened to it
  friend bool operator==(const JointMemory&, const JointMemory&) = default;
};

/// Dry joints with this plastic slip at their two ends [m], 2 x joints.
std::vector<JointMemory> memory_of_slip(const Eigen::Matrix2Xd& slip);

/// The plastic slip that dry joints remember [m], 2 x joints.
Eigen::Matrix2Xd slip_of(const std::vector<JointMemory>& memory);

struct State {
  Field displacement;               ///< [m], 2 x nodes; NaN at nodes of removed blocks
  std::vector<JointMemory> memory;  ///< of each joint; empty: nothing has slipped
};

}  // namespace voussoir
